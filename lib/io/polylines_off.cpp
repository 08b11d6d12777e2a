// What stands in for polylines.cpp when plait is built without assimp.
#include "io/formats.hpp"

namespace plait {

Result<StrandSet> read_polylines(const std::string& path, const ReadOptions&) {
    return Error{PLAIT_UNSUPPORTED,
                 format("%s: polylines need assimp, which this build of plait is without "
                        "(configure with -DPLAIT_ASSIMP=ON)",
                        path.c_str())};
}

Result<StrandSet> read_polylines(ByteVector, const std::string& file, const ReadOptions& options) {
    return read_polylines(file, options);
}

} // namespace plait
