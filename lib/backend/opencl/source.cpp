#include "backend/opencl/source.hpp"

#include "backend/opencl/embedded.hpp"
#include "base/format.hpp"

#include <algorithm>
#include <optional>
#include <regex>

namespace plait::opencl {
namespace {

struct Include {
    std::string name;
    bool angled;
};

std::optional<Include> parse_include(std::string_view line) {
    const auto skip_space = [&] {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    };
    const auto skip = [&](std::string_view token) {
        skip_space();
        const bool found = line.starts_with(token);
        line.remove_prefix(found ? token.size() : 0);
        return found;
    };
    if (!skip("#") || !skip("include"))
        return {};
    skip_space();
    if (line.empty() || (line.front() != '"' && line.front() != '<'))
        return {};
    const bool angled = line.front() == '<';
    const size_t end = line.find(angled ? '>' : '"', 1);
    if (end == line.npos)
        return {};
    return Include{std::string(line.substr(1, end - 1)), angled};
}

const EmbeddedFile* find_embedded(std::string_view name) {
    const auto files = embedded_files();
    const auto found = std::ranges::find(files, name, &EmbeddedFile::name);
    return found == files.end() ? nullptr : &*found;
}

// No two stages share a name, so that it tells the room, too.
const EmbeddedFile* find_kernel(const std::string& stage) {
    const std::string end = "/" + stage + ".cl";
    const auto files = embedded_files();
    const auto found = std::ranges::find_if(
        files, [&](const EmbeddedFile& file) { return file.name.ends_with(end); });
    return found == files.end() ? nullptr : &*found;
}

const EmbeddedFile* resolve(const std::string& includer, const std::string& name) {
    const std::string beside = includer.substr(0, includer.rfind('/') + 1);
    for (const std::string& folder : {beside, std::string("cl/"), std::string("cl/shared/")})
        if (const EmbeddedFile* file = find_embedded(folder + name))
            return file;
    return nullptr;
}

class Flattener {
  public:
    Status append(std::string_view name, std::string_view text) {
        const auto file = static_cast<uint32_t>(source_.files.size());
        source_.files.emplace_back(name);
        emit_line_of({file, 1});
        for (uint32_t line = 1; !text.empty(); ++line) {
            const size_t end = std::min(text.find('\n'), text.size());
            PLAIT_TRY(append_line({file, line}, text.substr(0, end)));
            text.remove_prefix(std::min(end + 1, text.size()));
        }
        return {};
    }

    Source take() { return std::move(source_); }

  private:
    Status append_line(Source::Line origin, std::string_view line) {
        const auto include = parse_include(line);
        if (!include)
            return emit(origin, line);
        const std::string& includer = source_.files[origin.file];
        const EmbeddedFile* file = resolve(includer, include->name);
        if (!file && include->angled)
            return emit(origin, line);
        if (!file)
            return Error{PLAIT_COMPILE,
                         format("%s:%u: error: #include \"%s\": no such file among plait's cl/",
                                includer.c_str(), origin.line, include->name.c_str())};
        if (std::ranges::find(source_.files, file->name) != source_.files.end())
            return emit(origin, "");
        PLAIT_TRY(append(file->name, file->text()));
        emit_line_of({origin.file, origin.line + 1});
        return {};
    }

    Status emit(Source::Line origin, std::string_view line) {
        source_.text.append(line).push_back('\n');
        source_.lines.push_back(origin);
        return {};
    }

    void emit_line_of(Source::Line next) {
        std::string name = source_.files[next.file];
        std::erase_if(name, [](char c) { return c == '"' || c == '\\' || c == '\n'; });
        (void)emit(next, format("#line %u \"%s\"", next.line, name.c_str()));
    }

    Source source_;
};

} // namespace

Result<Source> flatten(std::string_view name, std::string_view text) {
    Flattener flattener;
    PLAIT_TRY(flattener.append(name, text));
    return flattener.take();
}

std::string stage_file(const std::string& stage) {
    const EmbeddedFile* file = find_kernel(stage);
    return file ? std::string(file->name) : std::string();
}

std::string_view stage_text(const std::string& stage) {
    const EmbeddedFile* file = find_kernel(stage);
    return file ? file->text() : std::string_view();
}

std::string with_true_lines(const Source& source, const std::string& log) {
    static const std::regex place_pattern(R"(([^\s:]+):(\d{1,7}):(\d+): )");
    std::string result;
    auto rest = log.cbegin();
    for (std::sregex_iterator it(log.begin(), log.end(), place_pattern), end; it != end; ++it) {
        const std::smatch& match = *it;
        const size_t line = std::stoul(match[2]);
        const bool ours = std::ranges::find(source.files, match[1].str()) != source.files.end();
        if (ours || line == 0 || line > source.lines.size())
            continue;
        const Source::Line origin = source.lines[line - 1];
        result.append(rest, match[0].first);
        result += format("%s:%u:%s: ", source.files[origin.file].c_str(), origin.line,
                         match[3].str().c_str());
        rest = match[0].second;
    }
    return result.append(rest, log.cend());
}

} // namespace plait::opencl
