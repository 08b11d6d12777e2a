#include "figure.hpp"
#include "loaded.hpp"
#include "read_field.hpp"

#include <plait/plait_formats.h>
#include <plait/plait_levels.h>
#include <plait/plait_offline.h>

#include <Eigen/Dense>

#include <algorithm>

namespace simulate {

using Eigen::Vector3f;

namespace {

// The mannequin's neck twists between these heights, m.
constexpr std::array<float, 2> mannequin_neck{-0.19f, -0.09f};

template <typename T> plait_view view_of(const std::vector<T>& data, size_t components) {
    return {data.data(), data.size() / components, 0};
}

plait_groom_info describe(const plait_groom* groom) {
    plait_groom_info info{};
    info.struct_size = sizeof info;
    check(plait_groom_describe(groom, &info));
    return info;
}

GroomHandle generate(const plait_generator::Style& style) {
    const plait_generator::Strands strands = make_groom(style);
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = view_of(strands.positions, 3);
    desc.vertex_counts = view_of(strands.vertex_counts, 1);
    desc.strand_uv = view_of(strands.uv, 2);
    desc.thickness = view_of(strands.thickness, 1);
    plait_groom* groom = nullptr;
    check(plait_groom_create(&desc, nullptr, &groom));
    return GroomHandle(groom);
}

// `wanted` strands spread evenly over the order of the file. Skin and UV are left out.
GroomHandle thin_out(const plait_groom* groom, uint32_t wanted) {
    const auto positions = read_field<float>(groom, PLAIT_GROOM_FIELD_POSITIONS);
    const auto counts = read_field<uint32_t>(groom, PLAIT_GROOM_FIELD_VERTEX_COUNTS);
    std::vector<float> kept;
    std::vector<uint32_t> kept_counts;
    size_t first = 0;
    for (size_t strand = 0; strand < counts.size(); ++strand) {
        const size_t end = first + counts[strand];
        if ((strand + 1) * wanted / counts.size() > strand * wanted / counts.size()) {
            kept.insert(kept.end(), &positions[3 * first], positions.data() + 3 * end);
            kept_counts.push_back(counts[strand]);
        }
        first = end;
    }
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = view_of(kept, 3);
    desc.vertex_counts = view_of(kept_counts, 1);
    plait_groom* thinned = nullptr;
    check(plait_groom_create(&desc, nullptr, &thinned));
    return GroomHandle(thinned);
}

std::string notes_of(const plait_groom* groom) {
    size_t size = 0;
    check(plait_groom_read_notes(groom, nullptr, &size));
    std::vector<char> notes(size);
    check(plait_groom_read_notes(groom, notes.data(), &size));
    return notes.data();
}

// The info and the notes are those of the whole file even when strands are left out.
GroomHandle load(const GroomChoice& choice, plait_groom_info& info, std::string& notes) {
    plait_import_options options = plait_import_options_defaults();
    options.scale = choice.scale;
    options.resample = choice.vertices;
    options.axes = choice.axes;
    options.root_end = choice.root_end;
    plait_groom* loaded = nullptr;
    check(plait_groom_load(choice.name.c_str(), &options, &loaded));
    GroomHandle groom(loaded);
    info = describe(groom.get());
    notes = notes_of(groom.get());
    if (choice.strands == 0 || choice.strands >= info.strands)
        return groom;
    GroomHandle thinned = thin_out(groom.get(), choice.strands);
    const plait_groom_info whole = info;
    info = describe(thinned.get());
    std::copy(std::begin(whole.repairs), std::end(whole.repairs), std::begin(info.repairs));
    info.repairs_total = whole.repairs_total;
    std::copy(std::begin(whole.first_repair), std::end(whole.first_repair),
              std::begin(info.first_repair));
    return thinned;
}

std::vector<Vector3f> roots_of(const plait_groom* groom) {
    const auto positions = read_field<float>(groom, PLAIT_GROOM_FIELD_POSITIONS);
    std::vector<Vector3f> roots;
    size_t vertex = 0;
    for (const uint32_t count : read_field<uint32_t>(groom, PLAIT_GROOM_FIELD_VERTEX_COUNTS)) {
        roots.emplace_back(positions[3 * vertex], positions[3 * vertex + 1],
                           positions[3 * vertex + 2]);
        vertex += count;
    }
    return roots;
}

// Least-squares sphere through the roots: |p|^2 = 2 c.p + (r^2 - |c|^2), linear in c and the rest.
// Coordinates are about their mean, which keeps the system well conditioned.
void fit_sphere(const std::vector<Vector3f>& roots, Vector3f& centre, float& radius) {
    Vector3f mean = Vector3f::Zero();
    for (const Vector3f& root : roots)
        mean += root / static_cast<float>(roots.size());
    Eigen::Matrix4f normal = Eigen::Matrix4f::Zero();
    Eigen::Vector4f right = Eigen::Vector4f::Zero();
    for (const Vector3f& root : roots) {
        const Vector3f p = root - mean;
        const Eigen::Vector4f row(2.0f * p.x(), 2.0f * p.y(), 2.0f * p.z(), 1.0f);
        normal += row * row.transpose();
        right += p.squaredNorm() * row;
    }
    const Eigen::Vector4f solution = normal.completeOrthogonalDecomposition().solve(right);
    centre = mean + solution.head<3>();
    radius = std::sqrt(std::max(0.0f, solution.w() + solution.head<3>().squaredNorm()));
}

// For a groom from a file: one sphere under the roots, small enough to hold no hair at rest.
std::vector<Collider> skull_under(const plait_groom* groom) {
    Vector3f centre;
    float radius = 0.0f;
    fit_sphere(roots_of(groom), centre, radius);
    const auto positions = read_field<float>(groom, PLAIT_GROOM_FIELD_POSITIONS);
    std::vector<float> distances;
    for (size_t v = 0; v < positions.size(); v += 3)
        distances.push_back(
            (Vector3f(positions[v], positions[v + 1], positions[v + 2]) - centre).norm());
    const auto low = distances.begin() + static_cast<ptrdiff_t>(distances.size() / 100);
    std::nth_element(distances.begin(), low, distances.end());
    Collider skull{plait_collider_desc_defaults(), true};
    for (int axis = 0; axis < 3; ++axis)
        skull.shape.capsule.a[axis] = skull.shape.capsule.b[axis] = centre[axis];
    skull.shape.capsule.radius_a = skull.shape.capsule.radius_b =
        std::max(1e-4f, std::min(radius, *low));
    return {skull};
}

// The capsules are inscribed in the mannequin: hair on the shoulders would lie in them. On the head,
// where hair grows, there is no room for this.
constexpr float body_margin = 0.012f; // m

std::vector<Collider> generated_colliders(bool on_ball) {
    using namespace plait_generator;
    std::vector<Collider> colliders;
    for (const Capsule& capsule : on_ball ? ball_colliders() : head_colliders()) {
        Collider collider{plait_collider_desc_defaults(), capsule.moves_with_head};
        std::copy_n(capsule.a, 3, collider.shape.capsule.a);
        std::copy_n(capsule.b, 3, collider.shape.capsule.b);
        const float margin = capsule.moves_with_head ? 0 : body_margin;
        collider.shape.capsule.radius_a = capsule.radius_a + margin;
        collider.shape.capsule.radius_b = capsule.radius_b + margin;
        colliders.push_back(collider);
    }
    return colliders;
}

// Below the middle of the roots, as low as they go: about where the skull meets the spine.
Vector pivot_under(const std::vector<Vector3f>& roots) {
    Eigen::AlignedBox3f box;
    for (const Vector3f& root : roots)
        box.extend(root);
    return {box.center().x(), box.min().y(), box.center().z()};
}

HeadMesh make_head(const Scene& scene) {
    if (!scene.head.file.empty())
        return load_head(scene.head.file, scene.groom.scale);
    if (!scene.groom.generated || scene.head_is_mesh())
        return {};
    const bool fur = scene.groom.style.hairstyle == plait_generator::Hairstyle::Fur;
    return scene.groom.on_ball() ? ball(fur) : mannequin();
}

Vector3f mean_of(const std::vector<Vector3f>& points) {
    Vector3f mean = Vector3f::Zero();
    for (const Vector3f& point : points)
        mean += point / static_cast<float>(points.size());
    return mean;
}

// The square root of the area that points spread over, from their two greatest variances.
float spread_of(const std::vector<Vector3f>& points) {
    const Vector3f mean = mean_of(points);
    Eigen::Matrix3f variance = Eigen::Matrix3f::Zero();
    for (const Vector3f& point : points)
        variance += (point - mean) * (point - mean).transpose() / static_cast<float>(points.size());
    const Vector3f values =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f>(variance).eigenvalues().cwiseMax(0.0f);
    return std::pow(values[1] * values[2], 0.25f);
}

// What spread_of() is for the mannequin's scalp, m.
constexpr float mannequin_spread = 0.0554f;

// Of a tuft or a single strand, whose roots are in one place, its length says how large it is.
float relative_size(const std::vector<Vector3f>& roots, float mean_length) {
    constexpr float least_share = 0.02f; // of its length
    return std::max(spread_of(roots), least_share * mean_length) / mannequin_spread;
}

// Hair that hangs behind the head, as a braid does, is seen from behind: from the side where it is,
// off the middle.
float best_azimuth(const plait_groom* groom, const std::vector<Vector3f>& roots) {
    constexpr float from_front = 30.0f, from_behind = 145.0f, well_behind = 1.0f;
    const auto positions = read_field<float>(groom, PLAIT_GROOM_FIELD_POSITIONS);
    std::vector<Vector3f> vertices;
    for (size_t v = 0; v < positions.size(); v += 3)
        vertices.emplace_back(positions[v], positions[v + 1], positions[v + 2]);
    const float behind = mean_of(roots).z() - mean_of(vertices).z();
    return behind > well_behind * spread_of(roots) ? from_behind : from_front;
}

std::vector<Collider> made_for(const Scene& scene, const plait_groom* groom) {
    return scene.groom.generated ? generated_colliders(scene.groom.on_ball()) : skull_under(groom);
}

// None are made where the head itself is a collider.
void add_colliders(const Scene& scene, Figure& figure) {
    figure.meshes = load_meshes(scene.meshes, scene.groom.generated);
    if (scene.body)
        figure.body = std::make_unique<Body>(*scene.body, scene.groom.generated);
    if (scene.mannequin_is_meshes())
        for (LoadedMesh& part : mannequin_parts())
            figure.meshes.push_back(std::move(part));
    if (scene.colliders)
        figure.colliders = *scene.colliders;
    else
        (scene.head_is_mesh() || scene.mannequin_is_meshes() ? figure.stand_ins
                                                             : figure.colliders) =
            made_for(scene, figure.groom.get());
    figure.colliders.insert(figure.colliders.end(), scene.moving_colliders.begin(),
                            scene.moving_colliders.end());
}

// Loaded twice where the size decides about the unit.
void load_groom(Scene& scene, Figure& figure) {
    GroomChoice& choice = scene.groom;
    if (choice.generated) {
        figure.groom = generate(choice.style);
        figure.info = describe(figure.groom.get());
        return;
    }
    figure.groom = load(choice, figure.info, figure.notes);
    if (!choice.scale_by_size)
        return;
    choice.scale = figure.info.likely_scale;
    if (choice.scale != 1.0f)
        figure.groom = load(choice, figure.info, figure.notes);
}

void choose_guides(const Scene& scene, Figure& figure) {
    const uint32_t wanted = scene.groom.guides;
    if (scene.changes_level() || !(scene.groom.level || wanted > 0))
        return;
    if (wanted > figure.info.strands)
        throw Failure("guides is " + std::to_string(wanted) + ", " + scene.groom.name + " has " +
                      std::to_string(figure.info.strands) + " strands");
    auto [guides, follows] = take_level(scene, make_levels(scene, figure).get());
    if (describe(guides.get()).strands == figure.info.strands)
        return; // none follows
    figure.guides = std::move(guides);
    figure.follows = std::move(follows);
}

HeadMesh solids_of(const Figure& figure) {
    HeadMesh all{{}, figure.head.triangles, figure.head.scalp};
    auto first = static_cast<uint32_t>(figure.head.vertices.size());
    all.scalp.resize(first, 0.0f);
    const auto add = [&](const HeadMesh& part) {
        for (const auto& [a, b, c] : part.triangles)
            all.triangles.push_back({first + a, first + b, first + c});
        first += static_cast<uint32_t>(part.vertices.size());
        all.scalp.insert(all.scalp.end(), part.scalp.begin(), part.scalp.end());
        all.scalp.resize(first, 0.0f);
    };
    for (const LoadedMesh& mesh : figure.meshes)
        if (mesh.choice.drawn)
            add(mesh.shape);
    if (figure.draws_body())
        add(figure.body->mesh().shape);
    for (const Hand& hand : figure.hands)
        add(hand.mesh());
    return all;
}

} // namespace

LevelsHandle make_levels(const Scene& scene, const Figure& figure, plait_view hung,
                         const plait_roots* roots) {
    plait_levels_desc desc = plait_levels_desc_defaults();
    desc.groom = figure.groom.get();
    desc.seed = scene.seed;
    desc.hung = hung;
    desc.roots = roots;
    if (scene.groom.guides > 0) {
        desc.level_count = 1;
        desc.guides[0] = scene.groom.guides;
    }
    plait_levels* levels = nullptr;
    check(plait_levels_create(&desc, &levels));
    return LevelsHandle(levels);
}

std::pair<GroomHandle, FollowMapHandle> take_level(const Scene& scene, const plait_levels* levels) {
    plait_groom* guides = nullptr;
    plait_follow_map* follows = nullptr;
    check(plait_levels_take(levels, scene.groom.level.value_or(0), &guides, &follows));
    return {GroomHandle(guides), FollowMapHandle(follows)};
}

Figure make_figure(Scene& scene) {
    Figure figure{};
    const bool generated = scene.groom.generated;
    load_groom(scene, figure);
    choose_guides(scene, figure);
    figure.head = make_head(scene);
    add_colliders(scene, figure);
    for (const Collider& collider : scene.moving_colliders)
        figure.hands.emplace_back(collider);
    const std::vector<Vector3f> roots = roots_of(figure.groom.get());
    figure.pivot = generated ? Vector{} : pivot_under(roots);
    figure.pivot = scene.head.pivot.value_or(figure.pivot);
    figure.neck = scene.head.neck;
    if (generated && !scene.groom.on_ball() && scene.head.file.empty() && !figure.neck &&
        !scene.head_is_mesh())
        figure.neck = mannequin_neck;
    figure.hair_bounds = {Vector3f(figure.info.bounds_min), Vector3f(figure.info.bounds_max)};
    figure.azimuth = scene.camera.azimuth.value_or(best_azimuth(figure.groom.get(), roots));
    figure.size = relative_size(roots, figure.info.mean_length);
    figure.solids = solids_of(figure);
    if (figure.body)
        scene.motion = figure.body->motion();
    return figure;
}

uint32_t Figure::simulated_strands() const {
    return static_cast<uint32_t>(describe(simulated()).strands);
}

std::vector<uint32_t> Figure::of_simulated(const std::vector<uint32_t>& of_strands) const {
    if (!follows || of_strands.empty())
        return of_strands;
    auto of_guides = read_field<uint32_t>(follows.get(), PLAIT_FOLLOW_MAP_FIELD_STRANDS); // first
    of_guides.resize(simulated_strands());
    for (uint32_t& strand : of_guides)
        strand = of_strands[strand];
    return of_guides;
}

plait_pose Figure::pose_of_share(const plait_pose& head_pose, float share) const {
    const Eigen::Quaternionf turn(head_pose.q[3], head_pose.q[0], head_pose.q[1], head_pose.q[2]);
    const Vector3f move(head_pose.t), centre(pivot.data());
    const Vector3f offset = turn * centre + move - centre; // of the pivot
    const Eigen::Quaternionf part = Eigen::Quaternionf::Identity().slerp(share, turn);
    const Vector3f t = centre + share * offset - part * centre;
    return {{part.x(), part.y(), part.z(), part.w()}, {t.x(), t.y(), t.z()}};
}

std::vector<Vector3f> Figure::posed_head(const plait_pose& pose) const {
    std::vector<Vector3f> posed;
    posed.reserve(head.vertices.size());
    for (const Vector3f& vertex : head.vertices) {
        const float up = neck ? (vertex.y() - (*neck)[0]) / ((*neck)[1] - (*neck)[0]) : 1.0f;
        const float share = std::clamp(up, 0.0f, 1.0f);
        const plait_pose part = pose_of_share(pose, share * share * (3.0f - 2.0f * share));
        const Eigen::Quaternionf turn(part.q[3], part.q[0], part.q[1], part.q[2]);
        posed.push_back(turn * vertex + Vector3f(part.t));
    }
    return posed;
}

std::vector<Vector3f> Figure::posed_solids(const plait_pose& pose, float time) const {
    std::vector<Vector3f> posed = posed_head(pose);
    const auto add = [&](const HeadMesh& part, const plait_pose& place) {
        const Eigen::Quaternionf turn(place.q[3], place.q[0], place.q[1], place.q[2]);
        for (const Vector3f& vertex : part.vertices)
            posed.push_back(turn * vertex + Vector3f(place.t));
    };
    for (const LoadedMesh& mesh : meshes)
        if (mesh.choice.drawn)
            add(mesh.shape, mesh.choice.moves_with_head ? pose : mesh.choice.desc.pose);
    if (draws_body())
        for (const auto& p : body->positions(time))
            posed.emplace_back(p[0], p[1], p[2]);
    for (const Hand& hand : hands)
        add(hand.mesh(), hand.pose(time));
    return posed;
}

} // namespace simulate
