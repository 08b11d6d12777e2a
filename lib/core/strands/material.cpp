#include "core/strands/material.hpp"

#include <plait/constants.h>
#include <plait/params.h>

#include <algorithm>
#include <numeric>

namespace plait {
namespace {

constexpr size_t components = PLAIT_LANE_MATERIAL_COMPONENTS;
constexpr double earth = 9.80665; // m/s^2

// N/m^2: a spring to the groom with which half of the droop of a level strand is left, within a
// twentieth of its droop, however stiff it is. 2 is a limp strand's, 12 a stiff one's; between them
// is what the droop of strands of every stiffness was seen to need.
double half_droop(const Material& own, double length) {
    const double weight = double(own.line_density) * own.density.mean() * earth;
    const double bend = double(own.bend_stiffness) * own.stiffness.mean();
    return std::hypot(2 * weight / length, 12 * bend / (length * length * length * length));
}

class Writer {
  public:
    Writer(LaneRows& rows, const LaneLayout& layout) : rows_(rows), layout_(layout) {}

    void strand(size_t strand, const RestStrand& s);
    void groom(size_t strand, const RestStrand& s, const Material& own);
    void scales(size_t strand, double drag, double friction, bool weighed) {
        set(strand, layout_.row - 1, PLAIT_LANE_DRAG, drag);
        set(strand, layout_.row - 1, PLAIT_LANE_FRICTION, friction);
        set(strand, layout_.row - 1, PLAIT_LANE_WEIGHED, weighed ? 1 : 0);
    }

  private:
    void set(size_t strand, size_t row, size_t component, double value) {
        rows_.material[layout_.index(strand, row, component, components)] =
            static_cast<float>(value);
    }
    void set(std::pmr::vector<float>& to, size_t strand, size_t row, const Quat& q) const {
        for (int c = 0; c < 4; ++c)
            to[layout_.index(strand, row, static_cast<size_t>(c), 4)] =
                static_cast<float>(q.coeffs()[c]);
    }

    LaneRows& rows_;
    const LaneLayout& layout_;
};

void Writer::strand(size_t strand, const RestStrand& s) {
    for (size_t i = 0; i < s.x.size(); ++i)
        set(strand, i, PLAIT_LANE_MASS, s.mass[i]);
    for (size_t i = 0; i < s.segments(); ++i) {
        set(strand, i, PLAIT_LANE_LENGTH, s.length[i]);
        set(strand, i, PLAIT_LANE_STRETCH, s.stretch[i]);
        const double limp = PLAIT_LANE_LEAST_BEND * s.stretch[i] * s.length[i] * s.length[i];
        set(strand, i, PLAIT_LANE_BEND, std::max(s.bend[i], limp));
        set(strand, i, PLAIT_LANE_TWIST, s.bend[i] * (s.twist - 1));
        set(strand, i, PLAIT_LANE_CROSS, s.bend[i] * (s.cross - 1));
        set(rows_.rest, strand, i, s.rest[i]);
        if (!rows_.start.empty())
            set(rows_.start, strand, i,
                (i == 0 ? Quat::Identity() : s.frame[i - 1].conjugate()) * s.frame[i]);
    }
}

void Writer::groom(size_t strand, const RestStrand& s, const Material& own) {
    const double droop = half_droop(own, s.whole);
    double along = 0;
    for (size_t i = 1; i < s.x.size(); ++i) {
        along += s.edge(i - 1).norm();
        const double hair = own.groom_ramp.at(along / s.whole) * s.hair_of(i);
        const auto put = [&](size_t component, double value) {
            rows_.groom[layout_.index(strand, i, component, PLAIT_LANE_GROOM_COMPONENTS)] =
                static_cast<float>(value);
        };
        put(PLAIT_LANE_GROOM_OWN, double(own.groom) * hair);
        put(PLAIT_LANE_GROOM_DROOP, droop * hair);
    }
}

// As rows past a tip are.
LaneRows empty_rows(const LaneLayout& layout, bool has_start, std::pmr::memory_resource* memory) {
    using Floats = std::pmr::vector<float>;
    LaneRows rows{Floats(memory), Floats(memory), Floats(memory), Floats(memory), {}};
    rows.material.resize(layout.rows() * components);
    rows.rest.resize(layout.rows() * 4);
    for (size_t strand = 0; strand < layout.padded_strands(); ++strand)
        for (uint32_t i = 0; i < layout.row; ++i) {
            rows.material[layout.index(strand, i, PLAIT_LANE_MASS, components)] = 1;
            rows.rest[layout.index(strand, i, 3, 4)] = 1; // the identity
        }
    if (has_start)
        rows.start = rows.rest;
    return rows;
}

} // namespace

const Material& Materials::of(uint32_t strand) const {
    return list[table->of.empty() ? 0 : table->of[strand]];
}

bool Materials::curls() const {
    return std::ranges::any_of(list, [](const Material& m) { return m.curl != 1; });
}

bool Materials::holds() const {
    return std::ranges::any_of(list, [](const Material& m) { return m.groom > 0; });
}

LaneRows lane_rows(const RestStrands& strands, std::span<const uint32_t> members,
                   const LaneLayout& layout, const Materials& materials, const RestLoad& load,
                   bool grooms, std::pmr::memory_resource* memory) {
    const bool loaded = load.mode != PLAIT_SAG_FREE_OFF;
    const Vec3 gravity = Eigen::Vector3f(load.gravity.data()).cast<double>();
    LaneRows rows = empty_rows(layout, loaded || materials.curls(), memory);
    if (grooms)
        rows.groom.resize(layout.rows() * PLAIT_LANE_GROOM_COMPONENTS);
    Writer writer(rows, layout);
    std::pmr::vector<size_t> first(strands.counts.size(), memory); // vertex of each strand
    std::exclusive_scan(strands.counts.begin(), strands.counts.end(), first.begin(), size_t{0});
    const std::span<const float> positions = strands.positions;
    for (size_t lane = 0; lane < members.size(); ++lane) {
        const uint32_t strand = members[lane];
        Material own = materials.of(strand);
        if (!strands.stiffness.empty())
            own.scale(strands.stiffness[strand]);
        RestStrand s(positions.subspan(3 * first[strand], size_t{3} * strands.counts[strand]), own,
                     memory);
        if (grooms)
            writer.groom(lane, s, own);
        if (loaded)
            rows.sag.add(remove_sag(s, gravity, load.mode), strand);
        if (own.curl != 1)
            s.scale_curl(double(own.curl));
        writer.strand(lane, s);
        writer.scales(lane, double(own.drag), double(own.friction), own.stretch_stiffness == 0);
    }
    return rows;
}

} // namespace plait
