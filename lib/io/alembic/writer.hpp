// Curves to Alembic: /hair, a transform, above /hair/strands, the curves.
#pragma once

#include "io/alembic/compound.hpp"
#include "io/curves/clip.hpp"

#include <optional>

namespace plait {

class AlembicClip final : public ClipWriter {
  public:
    static Result<std::unique_ptr<ClipWriter>> create(const std::string& path,
                                                      const ClipRules& rules);

    Status begin(const ClipShape& shape) override;
    Status add_frame(double time, std::span<const float> positions) override;
    Status add_velocities(std::span<const float> velocities) override;
    Status commit() override;

  private:
    AlembicClip(NewFile file, const ClipRules& rules)
        : rules_(rules), file_(std::move(file)), out_(file_) {}

    Status add_geometry(CompoundWriter& geometry, uint32_t times, uint32_t samples);
    Result<OgawaWord> write_transform(OgawaWord child, uint32_t times, const SampleKey& below);
    Result<OgawaWord> write_object(const std::string& schema, CompoundWriter& properties,
                                   SampleKey& hash);
    Result<OgawaWord> write_root(OgawaWord top);
    ByteVector time_samplings(uint32_t samples) const;

    ClipRules rules_;
    NewFile file_;
    OgawaWriter out_;
    MetadataList metadata_;
    std::vector<double> times_;
    PropertySamples positions_, velocities_, bounds_;
    std::vector<uint32_t> vertex_counts_;
    std::vector<float> widths_, uv_;
};

} // namespace plait
