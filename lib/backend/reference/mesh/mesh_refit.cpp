// mesh_refit: the least box around the corners of all triangles under a node, at both ends of the step,
// a little larger for what float32 makes of places between, and the farthest way of one of them; of
// what has more than `least` triangles, around the boxes of the greatest nodes under it with no more.
#include "backend/reference/base/math.hpp"
#include "backend/reference/base/stages.hpp"

#include <algorithm>
#include <limits>

namespace plait::reference {
namespace {

struct Box {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    double way = 0;

    void cover(const Vec3& from, const Vec3& to, double its_way) {
        low = low.cwiseMin(from).cwiseMin(to);
        high = high.cwiseMax(from).cwiseMax(to);
        way = std::max(way, its_way);
    }
};

struct Tree {
    Tree(const mesh_refit_args& arguments, size_t mesh)
        : args(arguments), node(first(mesh, PLAIT_MESH_FIRST_NODE)),
          triangle(first(mesh, PLAIT_MESH_FIRST_TRIANGLE)),
          vertex(first(mesh, PLAIT_MESH_FIRST_VERTEX)) {}

    size_t under(size_t item, size_t what) const {
        return args.mesh_under[PLAIT_MESH_UNDER_STRIDE * (node + item) + what];
    }
    Box of_triangles(size_t begins, size_t number) const {
        Box box;
        for (size_t t = triangle + begins; t < triangle + begins + number; ++t)
            for (size_t k = 0; k < 3; ++k) {
                const size_t corner =
                    vertex + args.mesh_triangle[t * PLAIT_MESH_TRIANGLE_STRIDE + k];
                const Vec3 from = xyz(args.mesh_from[corner]), to = xyz(args.mesh_to[corner]);
                box.cover(from, to, (to - from).norm());
            }
        const double more = 4 * double{std::numeric_limits<float>::epsilon()} *
                            std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
        box.low.array() -= more;
        box.high.array() += more;
        return box;
    }
    Box of_nodes(size_t item, size_t least) const {
        Box box;
        const size_t end = item + under(item, 2);
        for (size_t i = item + 1; i < end; i += under(i, 1) <= least ? under(i, 2) : 1)
            if (under(i, 1) <= least)
                box.cover(xyz(args.mesh_box[2 * (node + i)]),
                          xyz(args.mesh_box[2 * (node + i) + 1]), args.mesh_way[node + i]);
        return box;
    }

    const mesh_refit_args& args;
    size_t node, triangle, vertex;

  private:
    size_t first(size_t mesh, size_t what) const {
        return args.mesh_first[mesh * PLAIT_MESH_FIRST_STRIDE + what];
    }
};

} // namespace

void mesh_refit(uint32_t item_count, const plait_mesh_refit_params& params,
                const mesh_refit_args& args) {
    const Tree tree(args, params.mesh);
    for (size_t item = 0; item < item_count; ++item) {
        const size_t begins = tree.under(item, 0), number = tree.under(item, 1);
        if (number <= params.least || number > params.most)
            continue;
        const Box box = params.least == 0 ? tree.of_triangles(begins, number)
                                          : tree.of_nodes(item, params.least);
        const size_t node = tree.node + item;
        args.mesh_box[2 * node] = with_w(box.low, 0);
        args.mesh_box[2 * node + 1] = with_w(box.high, 0);
        args.mesh_way[node] = box.way;
        if (item == 0)
            args.mesh_bends[params.mesh] = box.way * (1 + 1e-6);
    }
}

} // namespace plait::reference
