#include "io/usd/reader.hpp"

#include "io/formats.hpp"
#include "io/words.hpp"

namespace plait {
namespace {

constexpr std::string_view SIGNATURE = "#usda 1.0", BINARY = "PXR-USDC", ZIP = "PK\x03\x04";

// In front of a property's type, or of `rel`.
constexpr std::string_view QUALIFIERS[] = {"custom", "uniform", "varying", "config", "prepend",
                                           "append", "delete",  "add",     "reorder"};
// By which a prim brings in what other files or prims have.
constexpr std::string_view COMPOSED[] = {"references", "payload", "inherits", "specializes",
                                         "subLayers"};

} // namespace

// Metadata of the stage, in parentheses behind the signature.
Status UsdReader::read_stage() {
    if (!text_.take('('))
        return {};
    while (!text_.take(')')) {
        if (text_.next_is('"') || text_.next_is('\'')) { // a comment
            PLAIT_TRY(text_.string());
            continue;
        }
        auto name = text_.word();
        PLAIT_TRY(name);
        if (is_one_of(*name, QUALIFIERS))
            continue;
        PLAIT_TRY(text_.need('='));
        if (*name == "metersPerUnit") {
            size_t count = 0;
            PLAIT_TRY(text_.doubles(&metres_per_unit_, 1, count));
            if (!(metres_per_unit_ > 0 && metres_per_unit_ <= 1e6))
                return text_.bad(
                    format("metersPerUnit is %g; allowed is (0, 1e6]", metres_per_unit_));
            says_unit_ = true;
        } else if (*name == "upAxis") {
            PLAIT_TRY(read_up_axis());
        } else {
            if (is_one_of(*name, COMPOSED))
                composed_.add(*name);
            PLAIT_TRY(text_.skip_value());
        }
    }
    return {};
}

Status UsdReader::read_up_axis() {
    auto axis = text_.string();
    PLAIT_TRY(axis);
    if (*axis != "Y" && *axis != "Z")
        return text_.bad(
            format("upAxis is \"%s\"; allowed are \"Y\" and \"Z\"", shown(*axis).c_str()));
    z_up_ = *axis == "Z";
    says_up_ = true;
    return {};
}

Status UsdReader::read_prim_metadata(const std::string& path, bool& active) {
    if (!text_.take('('))
        return {};
    while (!text_.take(')')) {
        if (text_.next_is('"') || text_.next_is('\'')) {
            PLAIT_TRY(text_.string());
            continue;
        }
        auto name = text_.word();
        PLAIT_TRY(name);
        if (is_one_of(*name, QUALIFIERS))
            continue;
        if (is_one_of(*name, COMPOSED))
            composed_.add(std::string(*name) + " of " + path);
        PLAIT_TRY(text_.need('='));
        if (*name == "active") {
            auto truth = text_.word();
            PLAIT_TRY(truth);
            active = *truth != "false" && *truth != "0";
            continue;
        }
        PLAIT_TRY(text_.skip_value());
        PLAIT_TRY(text_.skip_metadata()); // an offset of a layer
    }
    return {};
}

// Behind `over`, as read_prim(): opinions about a prim that a file which is not read may define.
Status UsdReader::skip_over(const std::string& path) {
    if (!text_.next_is('"'))
        PLAIT_TRY(text_.word());
    auto name = text_.string();
    PLAIT_TRY(name);
    composed_.add("over " + path + "/" + shown(*name));
    PLAIT_TRY(text_.skip_metadata());
    return text_.skip_value();
}

// Behind `def`: [type] "name" [(metadata)] { body }.
Status UsdReader::read_prim(const Matrix& to_world, const std::string& path, uint32_t level) {
    if (level > MOST_LEVELS)
        return text_.bad(format("prims lie in more than %u levels of others", MOST_LEVELS));
    UsdPrim prim(memory_);
    prim.to_world = to_world;
    if (!text_.next_is('"')) {
        auto type = text_.word();
        PLAIT_TRY(type);
        prim.type = *type;
    }
    auto name = text_.string();
    PLAIT_TRY(name);
    prim.path = path + "/" + shown(*name);
    bool active = true;
    PLAIT_TRY(read_prim_metadata(prim.path, active));
    if (!active) {
        other_prims_.add(prim.path + " (inactive)");
        return text_.skip_value();
    }
    if (prim.type != "BasisCurves" && prim.type != "Xform" && prim.type != "Scope" &&
        !prim.type.empty())
        other_prims_.add(prim.type);
    return read_body(prim, level);
}

// Properties come before the children that they place, in what programs write; a child before them is
// an error rather than elsewhere.
Status UsdReader::read_body(UsdPrim& prim, uint32_t level) {
    PLAIT_TRY(text_.need('{'));
    bool has_children = false;
    Matrix placed = prim.to_world;
    while (!text_.take('}')) {
        auto word = text_.word();
        PLAIT_TRY(word);
        if (*word == "over") {
            PLAIT_TRY(skip_over(prim.path));
        } else if (*word == "def") {
            if (!has_children) {
                auto local = transform_of(prim);
                PLAIT_TRY(local);
                placed = *local;
            }
            has_children = true;
            PLAIT_TRY(read_prim(placed, prim.path, level + 1));
        } else if (*word == "class" || *word == "variantSet") {
            composed_.add(std::string(*word) + " of " + prim.path);
            while (!text_.next_is('{'))
                PLAIT_TRY(text_.take('=') ? Status() : text_.skip_value());
            PLAIT_TRY(text_.skip_value());
        } else {
            const size_t operations = prim.operations.size() + prim.operands.size();
            PLAIT_TRY(read_property(prim, *word));
            if (has_children && prim.operations.size() + prim.operands.size() != operations)
                return text_.bad(format("%s: its transform comes behind the prims that it moves; "
                                        "allowed is in front of them",
                                        prim.path.c_str()));
        }
    }
    if (prim.type != "BasisCurves")
        return {};
    auto world = transform_of(prim);
    PLAIT_TRY(world);
    return add_curves(prim, *world);
}

Status UsdReader::read_property(UsdPrim& prim, std::string_view type) {
    while (is_one_of(type, QUALIFIERS)) {
        auto next = text_.word();
        PLAIT_TRY(next);
        type = *next;
    }
    if (text_.take('[')) // of an array
        PLAIT_TRY(text_.need(']'));
    auto name = text_.word();
    PLAIT_TRY(name);
    if (!text_.take('='))
        return text_.skip_metadata(); // without a value
    constexpr std::string_view TIMES = ".timeSamples";
    const bool samples = name->ends_with(TIMES);
    const std::string_view plain = name->substr(0, name->size() - (samples ? TIMES.size() : 0));
    bool taken = false;
    PLAIT_TRY(take_property(prim, plain, samples, taken));
    if (!taken) {
        if (prim.type == "BasisCurves" && type != "rel")
            unused_.add(plain);
        PLAIT_TRY(text_.skip_value());
    }
    return text_.skip_metadata();
}

Result<StrandSet> UsdReader::read(Notes& notes) {
    PLAIT_TRY(read_stage());
    while (!text_.at_end()) {
        auto word = text_.word();
        PLAIT_TRY(word);
        if (*word == "over") {
            PLAIT_TRY(skip_over(""));
        } else if (*word == "def") {
            PLAIT_TRY(read_prim({}, "", 1));
        } else { // a class, or the order of prims
            while (!text_.next_is('{') && !text_.next_is('['))
                PLAIT_TRY(text_.take('=') ? Status() : text_.skip_value());
            PLAIT_TRY(text_.skip_value());
        }
    }
    notes.add(format("metersPerUnit is %g%s, upAxis is %s%s", metres_per_unit_,
                     says_unit_ ? "" : ", USD's default, as it is not given", z_up_ ? "Z" : "Y",
                     says_up_ ? "" : ", USD's default, as it is not given"));
    auto strands = strands_.finish(text_.file(), notes);
    Notes left_out;
    left_out.add("prims are not read", other_prims_);
    left_out.add("parts that come from elsewhere are not read", composed_);
    const std::string without = left_out.take();
    if (!strands)
        return Error{strands.error().code,
                     strands.error().message + (without.empty() ? "" : "; " + without)};
    notes.add("properties move and are read at their first sample", moving_);
    notes.add("properties are not read", unused_);
    if (!without.empty())
        notes.add(without);
    return strands;
}

Result<StrandSet> read_usd(const ByteReader& file, const ReadOptions& options) {
    const std::string_view text = after_mark(file.view(0, file.size()));
    for (const auto& [signature, what] :
         {std::pair(BINARY, "binary"), std::pair(ZIP, "an archive")})
        if (text.starts_with(signature))
            return usd_not_text(file.file(), what);
    if (!text.starts_with(SIGNATURE))
        return Error{PLAIT_BAD_DATA, format("%s: line 1: does not begin with \"%s\"",
                                            file.file().c_str(), SIGNATURE.data())};
    Notes notes;
    auto strands = UsdReader(text, file.file(), options).read(notes);
    if (options.notes)
        *options.notes = notes.take();
    return strands;
}

Error usd_not_text(const std::string& file, const char* what) {
    return {
        PLAIT_UNSUPPORTED,
        format("%s: is USD, but %s, which is not read; \"usdcat IN -o OUT.usda\" of USD makes text "
               "of it, which is",
               file.c_str(), what)};
}

} // namespace plait
