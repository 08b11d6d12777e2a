// One reader and writer per file format, from and to bytes in memory. docs/formats.md has the
// layouts.
#pragma once

#include "io/bytes.hpp"
#include "io/io.hpp"

#include <string_view>

namespace plait {

Result<StrandSet> read_tfx(const ByteReader& file, const ReadOptions& options);
Result<ByteVector> write_tfx(const StrandSet& strands);

// Adds bone_indices and bone_weights to `strands`, whose count the file must match.
Status read_tfxbone(const ByteReader& file, StrandSet& strands);
Result<ByteVector> write_tfxbone(const StrandSet& strands);

Result<StrandSet> read_hair(const ByteReader& file, const ReadOptions& options);
Result<ByteVector> write_hair(const StrandSet& strands);

// Curves of Alembic in Ogawa.
Result<StrandSet> read_alembic(const ByteReader& file, const ReadOptions& options);

// BasisCurves of USD text.
Result<StrandSet> read_usd(const ByteReader& file, const ReadOptions& options);
// UNSUPPORTED, for USD that is `what`: "binary".
Error usd_not_text(const std::string& file, const char* what);

// Strands of research on hair: counts and points; points of PLY with edges, or with a colour for each strand.
Result<StrandSet> read_strand_data(const ByteReader& file, const ReadOptions& options);
Result<StrandSet> read_ply(const ByteReader& file, const ReadOptions& options);

// Polylines of OBJ, once check_obj() has passed the text.
Result<StrandSet> read_polylines(const std::string& path, const ReadOptions& options);
// The same from memory; `file` is for messages.
Result<StrandSet> read_polylines(ByteVector text, const std::string& file,
                                 const ReadOptions& options);

// Triangles and skin of TressFX.
Result<RawMesh> read_tfxmesh(std::string_view text, const std::string& file,
                             const ReadOptions& options);

// Faces of OBJ, once check_obj() has passed the text, or of glTF, with the skin; as polylines.
Result<RawMesh> read_obj_mesh(const std::string& path, const ReadOptions& options);
Result<RawMesh> read_obj_mesh(ByteVector text, const std::string& file, const ReadOptions& options);
Result<RawMesh> read_gltf_mesh(const std::string& path, const ReadOptions& options);

} // namespace plait
