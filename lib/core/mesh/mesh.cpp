#include "core/mesh/mesh.hpp"

#include "base/format.hpp"
#include "core/groom/repair.hpp"
#include "core/mesh/mesh_edges.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace plait {
namespace {

using Vec3 = Eigen::Vector3d;

// Vertices so close together, in sizes of the mesh, are one: seams of texture coordinates have
// theirs twice.
constexpr double weld_distance = 1e-6;
// A triangle of less area than this, in squares of its longest edge, has no normal.
constexpr double least_area = 1e-12;
// Vertices whose weights differ by more than this, summed over bones, move apart: they are two.
constexpr double weld_skin = 1e-2;

Vec3 point(const MeshPoint& p) {
    return {double(p[0]), double(p[1]), double(p[2])};
}

// Where a cell of the welding grid is.
struct Cell {
    std::array<int64_t, 3> at;
    bool operator==(const Cell&) const = default;
};
struct CellHash {
    size_t operator()(const Cell& cell) const {
        uint64_t hash = 0xcbf29ce484222325u; // FNV-1a
        for (const int64_t c : cell.at)
            hash = (hash ^ static_cast<uint64_t>(c)) * 0x100000001b3u;
        return static_cast<size_t>(hash ^ (hash >> 32));
    }
};

// Finds, of points added before, the first within the distance that `alike`(its number) takes.
class Welder {
  public:
    Welder(double distance, std::pmr::memory_resource* memory)
        : distance_(distance), edge_(4 * distance), cells_(memory), next_(memory) {}

    template <typename Alike>
    uint32_t add(const MeshPoint& p, std::pmr::vector<MeshPoint>& kept, const Alike& alike) {
        uint32_t found = none;
        for_each_cell(point(p), [&](const Cell& cell) {
            const auto first = cells_.find(cell);
            for (uint32_t i = first == cells_.end() ? none : first->second; i != none; i = next_[i])
                if (i < found && (point(kept[i]) - point(p)).norm() <= distance_ && alike(i))
                    found = i;
        });
        if (found != none)
            return found;
        const auto index = static_cast<uint32_t>(kept.size());
        kept.push_back(p);
        const auto [place, fresh] = cells_.try_emplace(cell_of(point(p)), index);
        next_.push_back(fresh ? none : place->second);
        place->second = index;
        return index;
    }

  private:
    static constexpr uint32_t none = std::numeric_limits<uint32_t>::max();

    Cell cell_of(const Vec3& p) const {
        Cell cell{};
        for (size_t k = 0; k < 3; ++k)
            cell.at[k] = static_cast<int64_t>(std::floor(p[static_cast<int>(k)] / edge_));
        return cell;
    }
    // Those that hold points within the distance: one, but for points near a cell's side.
    template <typename Visit> void for_each_cell(const Vec3& p, const Visit& visit) const {
        const Cell low = cell_of(p - Vec3::Constant(distance_));
        const Cell high = cell_of(p + Vec3::Constant(distance_));
        for (int64_t x = low.at[0]; x <= high.at[0]; ++x)
            for (int64_t y = low.at[1]; y <= high.at[1]; ++y)
                for (int64_t z = low.at[2]; z <= high.at[2]; ++z)
                    visit(Cell{{x, y, z}});
    }

    double distance_, edge_;
    std::pmr::unordered_map<Cell, uint32_t, CellHash> cells_; // the newest point of each
    std::pmr::vector<uint32_t> next_;                         // in the same cell
};

class Mender {
  public:
    Mender(const RawMesh& raw, plait_repair_policy policy, const std::string& where, Mesh& mesh)
        : raw_(raw.surface), skin_(raw.skin), policy_(policy), where_(where), mesh_(mesh),
          memory_(mesh.surface.positions.get_allocator().resource()) {}

    Status mend(const RawMesh& raw) {
        PLAIT_TRY(check());
        if (raw.skins_reduced > 0)
            PLAIT_TRY(note(PLAIT_MESH_REPAIR_REDUCED_SKIN, raw.first_reduced, raw.skins_reduced));
        PLAIT_TRY(weld());
        PLAIT_TRY(take_triangles());
        drop_unused_vertices();
        if (mesh_.surface.triangles.empty())
            return bad(format("none of %zu triangles is left; allowed is 1 or more with an area",
                              raw_.triangles.size()));
        PLAIT_TRY(take_skin());
        MeshEdges edges(mesh_.surface.triangles, memory_);
        PLAIT_TRY(turn_outward(edges));
        measure_mesh(edges, mesh_);
        return {};
    }

  private:
    Error bad(const std::string& text) const { return {PLAIT_BAD_DATA, where_ + text}; }

    Status note(plait_mesh_repair kind, const std::string& what, uint64_t number = 1) {
        if (policy_ == PLAIT_REPAIR_POLICY_REFUSE)
            return bad(what + " (policy: refuse)");
        if (mesh_.repairs.total() == 0)
            mesh_.repairs.first = what;
        mesh_.repairs.count[kind] += number;
        return {};
    }

    // What is read of all that is given; vertices of no triangle are not.
    Status check() const {
        if (raw_.positions.size() > std::numeric_limits<uint32_t>::max())
            return bad(format("%zu vertices; allowed are up to 2^32 - 1", raw_.positions.size()));
        for (size_t t = 0; t < raw_.triangles.size(); ++t)
            for (const uint32_t corner : raw_.triangles[t]) {
                if (corner >= raw_.positions.size())
                    return bad(format("triangle %zu: index is %u, there are %zu vertices", t,
                                      corner, raw_.positions.size()));
                for (const float c : raw_.positions[corner])
                    if (!(std::abs(c) <= max_coordinate))
                        return bad(format("triangle %zu, vertex %u: coordinate is %g, range is "
                                          "[-1e6, 1e6] m",
                                          t, corner, double(c)));
            }
        return {};
    }

    double size() const {
        Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
        for (const Triangle& triangle : raw_.triangles)
            for (const uint32_t corner : triangle) {
                low = low.cwiseMin(point(raw_.positions[corner]));
                high = high.cwiseMax(point(raw_.positions[corner]));
            }
        return raw_.triangles.empty() ? 0 : (high - low).norm();
    }

    // Numbers of the vertices that are kept, by that of the raw ones, in their order.
    Status weld() {
        kept_.assign(raw_.positions.size(), unused);
        for (const Triangle& triangle : raw_.triangles)
            for (const uint32_t corner : triangle)
                kept_[corner] = 0;
        const double size = this->size();
        Welder welder(size > 0 ? weld_distance * size : 1.0, memory_); // 0: all are at one place
        for (size_t i = 0; i < kept_.size(); ++i) {
            if (kept_[i] == unused)
                continue;
            const size_t before = mesh_.surface.positions.size();
            kept_[i] = welder.add(raw_.positions[i], mesh_.surface.positions, [&](uint32_t kept) {
                return skin_.empty() ||
                       skin_difference(skin_, i, skin_, mesh_.sources[kept]) <= weld_skin;
            });
            if (mesh_.surface.positions.size() > before)
                mesh_.sources.push_back(static_cast<uint32_t>(i));
            else
                PLAIT_TRY(note(PLAIT_MESH_REPAIR_WELDED_VERTEX,
                               format("vertex %zu: within 1e-6 of the mesh's size, %g m, of one "
                                      "before, welded to it",
                                      i, size)));
        }
        return {};
    }

    bool has_area(const Triangle& t) const {
        const auto& x = mesh_.surface.positions;
        const Vec3 a = point(x[t[0]]), b = point(x[t[1]]), c = point(x[t[2]]);
        const double longest =
            std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
        return 0.5 * (b - a).cross(c - a).norm() > least_area * longest;
    }

    Status take_triangles() {
        std::pmr::unordered_map<Cell, size_t, CellHash> seen(memory_); // by its corners, in order
        for (size_t t = 0; t < raw_.triangles.size(); ++t) {
            Triangle triangle = raw_.triangles[t];
            for (uint32_t& corner : triangle)
                corner = kept_[corner];
            if (!has_area(triangle)) {
                PLAIT_TRY(note(PLAIT_MESH_REPAIR_DEGENERATE_TRIANGLE,
                               format("triangle %zu: has no area, dropped", t)));
                continue;
            }
            Triangle sorted = triangle;
            std::ranges::sort(sorted);
            const auto [place, fresh] =
                seen.try_emplace(Cell{{sorted[0], sorted[1], sorted[2]}}, t);
            if (fresh)
                mesh_.surface.triangles.push_back(triangle);
            else
                PLAIT_TRY(note(PLAIT_MESH_REPAIR_DUPLICATE_TRIANGLE,
                               format("triangle %zu: has the corners of triangle %zu, dropped", t,
                                      place->second)));
        }
        return {};
    }

    void drop_unused_vertices() {
        auto& x = mesh_.surface.positions;
        std::pmr::vector<uint32_t> number(x.size(), unused, memory_);
        for (const Triangle& triangle : mesh_.surface.triangles)
            for (const uint32_t corner : triangle)
                number[corner] = 0;
        uint32_t used = 0;
        for (size_t i = 0; i < x.size(); ++i)
            if (number[i] != unused) {
                x[used] = x[i];
                mesh_.sources[used] = mesh_.sources[i];
                number[i] = used++;
            }
        x.resize(used);
        mesh_.sources.resize(used);
        for (Triangle& triangle : mesh_.surface.triangles)
            for (uint32_t& corner : triangle)
                corner = number[corner];
    }

    // Of the vertices that are left. Weights are used as shares: rounding is taken out, anything more
    // is refused.
    Status take_skin() {
        if (skin_.empty())
            return {};
        for (const uint32_t i : mesh_.sources) {
            PLAIT_TRY(check_skin(i));
            mesh_.skin.indices.push_back(skin_.indices[i]);
            mesh_.skin.weights.push_back(normalized(skin_.weights[i]));
        }
        mesh_.skin.bones.assign(skin_.bones.begin(), skin_.bones.end());
        uint32_t highest = 0;
        for (const BoneIndices& indices : mesh_.skin.indices)
            highest = std::max(highest, std::ranges::max(indices));
        if (mesh_.skin.bones.size() <= highest)
            mesh_.skin.bones.resize(size_t{highest} + 1);
        return {};
    }

    Status check_skin(uint32_t i) const {
        const auto wrong = [&](const char* what, double value, const char* range) {
            return bad(format("vertex %u: %s is %g, range is %s", i, what, value, range));
        };
        double sum = 0;
        for (size_t k = 0; k < 4; ++k) {
            const float weight = skin_.weights[i][k];
            if (!(weight >= 0 && weight <= 1.001f))
                return wrong("bone weight", double(weight), "[0, 1]");
            if (skin_.indices[i][k] >= max_mesh_bones)
                return wrong("bone index", skin_.indices[i][k], "[0, 65535]");
            sum += double(weight);
        }
        if (!(std::abs(sum - 1) <= 1e-3))
            return wrong("sum of bone weights", sum, "1 +- 0.001");
        return {};
    }

    Status turn_outward(MeshEdges& edges) {
        const auto turned = plait::turn_outward(edges, mesh_.surface, memory_);
        if (turned.empty())
            return {};
        return note(PLAIT_MESH_REPAIR_FLIPPED_TRIANGLE,
                    format("triangle of the vertices %u, %u, %u: faces inward, turned",
                           turned.front()[0], turned.front()[1], turned.front()[2]),
                    turned.size());
    }

    static constexpr uint32_t unused = std::numeric_limits<uint32_t>::max();

    const TriangleSet& raw_;
    const MeshSkin& skin_;
    plait_repair_policy policy_;
    const std::string& where_;
    Mesh& mesh_;
    std::pmr::memory_resource* memory_;
    std::pmr::vector<uint32_t> kept_{memory_};
};

} // namespace

uint64_t MeshRepairs::total() const {
    return std::accumulate(count.begin(), count.end(), uint64_t{0});
}

Status build_mesh(const RawMesh& raw, plait_repair_policy policy, const std::string& where,
                  Mesh& mesh) {
    return Mender(raw, policy, where, mesh).mend(raw);
}

} // namespace plait
