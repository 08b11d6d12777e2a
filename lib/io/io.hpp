// Strands from and to files, and meshes from them. The extension decides the format, without regard to case; what each
// format holds is in docs/formats.md. Nothing is mended here.
#pragma once

#include "base/result.hpp"
#include "core/groom/strand_set.hpp"
#include "core/mesh/mesh.hpp"

#include <memory_resource>
#include <string>

namespace plait {

// Which curves of a file that tells guides from others.
enum class StrandPart { ALL = 0, GUIDES = 1, FOLLOWS = 2 };

struct ReadOptions {
    float scale = 1.0f; // file units to metres, applied to positions and thickness
    std::pmr::memory_resource* memory = std::pmr::get_default_resource(); // of what is read
    StrandPart part = StrandPart::ALL;
    std::string* notes = nullptr; // or: what was taken from the file and what was not, in sentences
};

// .tfx (TressFX 3 and 4, with the .tfxbone beside it, if any, as skin), .hair, polylines of .obj, curves
// of .abc and .usda. NOT_FOUND, IO, BAD_DATA (file, place, value, range), UNSUPPORTED.
Result<StrandSet> read_strands(const std::string& path, const ReadOptions& options = {});

// .tfx (version 4; strands of equal vertex counts; the skin, if any, to a .tfxbone beside it), .hair
// (without UV and skin), .abc or .usda (without skin). A file appears whole or not at all. IO,
// UNSUPPORTED.
Status write_strands(const std::string& path, const StrandSet& strands);

// Triangles of .obj, .gltf and .glb, where their nodes put them, and of .tfxmesh, with their skin;
// corners at one place that the same bones move share a vertex. NOT_FOUND, IO, BAD_DATA, UNSUPPORTED.
Result<RawMesh> read_mesh(const std::string& path, const ReadOptions& options = {});

} // namespace plait
