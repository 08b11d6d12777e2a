#include "io/curves/clip.hpp"

#include "io/alembic/writer.hpp"
#include "io/curves/save.hpp"
#include "io/extension.hpp"
#include "io/usd/writer.hpp"

namespace plait {

Result<std::unique_ptr<ClipWriter>> make_clip_writer(const std::string& path,
                                                     const ClipRules& rules) {
    const std::string extension = extension_of(path);
    if (extension == ".abc")
        return AlembicClip::create(path, rules);
    if (extension == ".usda")
        return UsdClip::create(path, rules);
    return Error{PLAIT_UNSUPPORTED,
                 format("%s: cannot write curves that move to \"%s\"; known are .abc, .usda",
                        path.c_str(), extension.c_str())};
}

Status save_curves(const std::string& path, const StrandSet& strands) {
    ClipRules rules;
    rules.moves = false;
    rules.memory = strands.positions.get_allocator().resource();
    auto clip = make_clip_writer(path, rules);
    PLAIT_TRY(clip);
    PLAIT_TRY((*clip)->begin({strands.vertex_counts, strands.thickness, strands.strand_uv}));
    PLAIT_TRY((*clip)->add_frame(0, strands.positions));
    return (*clip)->commit();
}

} // namespace plait
