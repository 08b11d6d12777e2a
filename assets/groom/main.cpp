// plait-groom: plait-groom long --strands 10000 --vertices 16 --seed 1 --out long.tfx
#include "generator/generator.hpp"
#include "gltf.hpp"
#include "obj.hpp"

#include <plait/plait.h>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <string>

using namespace plait_generator;

namespace {

// "" if the hairstyle was written; else what failed.
std::string write_groom(const Style& style, const std::string& path) {
    const Strands strands = make_groom(style);
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = {strands.positions.data(), strands.positions.size() / 3, 0};
    desc.vertex_counts = {strands.vertex_counts.data(), strands.vertex_counts.size(), 0};
    desc.strand_uv = {strands.uv.data(), strands.uv.size() / 2, 0};
    desc.thickness = {strands.thickness.data(), strands.thickness.size(), 0};

    plait_groom* groom = nullptr;
    plait_result result = plait_groom_create(&desc, nullptr, &groom);
    if (result == PLAIT_OK)
        result = plait_groom_save(groom, path.c_str());
    plait_groom_destroy(groom);
    return result == PLAIT_OK ? std::string() : plait_last_error();
}

// --wave-length for wave_length.
std::string option_name(const char* field) {
    std::string name = std::string("--") + field;
    for (char& c : name)
        c = c == '_' ? '-' : c;
    return name;
}

std::string range_text(const StyleField& field) {
    char text[64];
    std::snprintf(text, sizeof text, " [%g, %g]", field.least, field.most);
    return text;
}

void add_style(CLI::App& app, Hairstyle hairstyle, const char* about, std::string& out,
               std::string& problem) {
    const std::string name(hairstyle_name(hairstyle));
    CLI::App* command = app.add_subcommand(name, about);
    const auto style = std::make_shared<Style>(make_style(hairstyle));
    command->add_option("--strands", style->strands, "[1, 1000000]")->capture_default_str();
    command->add_option("--vertices", style->vertices, "per strand, [2, 256]")
        ->capture_default_str();
    command->add_option("--seed", style->seed, "of all randomness")->capture_default_str();
    command->add_option("--clumps", style->clumps, "locks that fall together, [1, 100000]")
        ->capture_default_str();
    for (const StyleField& field : style_fields())
        command
            ->add_option(option_name(field.name), (*style).*field.value,
                         field.meaning + range_text(field))
            ->capture_default_str();
    command->add_option("--out", out, "file to write, .tfx or .hair")->required();
    command->callback([style, &out, &problem] {
        problem = style_problem(*style);
        if (problem.empty())
            problem = write_groom(*style, out);
    });
}

void add_head(CLI::App& app, std::string& out, std::string& problem) {
    CLI::App* command =
        app.add_subcommand("head", "the head and shoulders that the hairstyles fit");
    const auto detail = std::make_shared<unsigned>(2);
    command->add_option("--detail", *detail, "[1, 4]; 2 has about 19,000 triangles")
        ->check(CLI::Range(1, 4))
        ->capture_default_str();
    command->add_option("--out", out, "file to write, .obj")->required();
    command->callback([detail, &out, &problem] {
        problem = plait_groom_tool::write_obj(make_head(*detail), out);
    });
}

void add_character(CLI::App& app, std::string& out, std::string& problem) {
    CLI::App* command =
        app.add_subcommand("character", "the same, coarser, with bones and a motion of 4 s");
    command->add_option("--out", out, "file to write, .gltf")->required();
    command->callback(
        [&out, &problem] { problem = plait_groom_tool::write_gltf(make_character(), out); });
}

int run(int argc, char** argv) {
    CLI::App app(
        "Hairstyles and a head by formula, the same bytes on every machine. Metres, y up.");
    app.set_version_flag("--version", "plait-groom " PROGRAM_VERSION);
    app.require_subcommand(1);
    std::string out, problem;
    add_style(app, Hairstyle::Long, "parted hair that falls over the shoulders", out, problem);
    add_style(app, Hairstyle::Braid, "combed back into a plait of three bundles", out, problem);
    add_style(app, Hairstyle::Curly, "helices, each clump its own", out, problem);
    add_style(app, Hairstyle::Short, "a few centimetres, swept back", out, problem);
    add_style(app, Hairstyle::Ponytail, "combed back through a holder behind the head", out,
              problem);
    add_style(app, Hairstyle::Ball, "in a layer on a ball of 10 cm, to be measured", out, problem);
    add_style(app, Hairstyle::Bob, "parted, and cut in one line below the jaw", out, problem);
    add_style(app, Hairstyle::Afro, "coils that stand away from the scalp", out, problem);
    add_style(app, Hairstyle::Dreadlocks, "locks as thick as a finger, a strand each", out,
              problem);
    add_style(app, Hairstyle::Beard, "on chin, jaw and upper lip", out, problem);
    add_style(app, Hairstyle::Fur, "all over a ball of 10 cm, combed down", out, problem);
    add_head(app, out, problem);
    add_character(app, out, problem);
    CLI11_PARSE(app, argc, argv);
    if (!problem.empty())
        std::fprintf(stderr, "plait-groom: %s\n", problem.c_str());
    return problem.empty() ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "plait-groom: %s\n", failure.what());
        return 1;
    }
}
