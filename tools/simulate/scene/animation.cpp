#include "animation.hpp"
#include "common/json_reader.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#ifdef PLAIT_WITH_ASSIMP
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#endif

namespace simulate {

using Eigen::Affine3f, Eigen::Quaternionf, Eigen::Vector3f;

namespace {

template <typename T, typename Between>
T sample_keys(const std::vector<Key<T>>& keys, float time, const Between& between) {
    const auto next = std::upper_bound(keys.begin(), keys.end(), time,
                                       [](float t, const Key<T>& key) { return t < key.time; });
    if (next == keys.begin())
        return keys.front().value;
    if (next == keys.end())
        return keys.back().value;
    const Key<T>& last = *(next - 1);
    return between(last.value, next->value, (time - last.time) / (next->time - last.time));
}

std::string lower(std::string text) {
    for (char& c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

#ifdef PLAIT_WITH_ASSIMP

Vector3f vector_of(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}
Quaternionf quaternion_of(const aiQuaternion& q) {
    return Quaternionf(q.w, q.x, q.y, q.z).normalized();
}

Affine3f transform_of(const aiMatrix4x4& m) {
    Affine3f transform = Affine3f::Identity();
    for (unsigned row = 0; row < 3; ++row)
        for (unsigned column = 0; column < 4; ++column)
            transform.matrix()(row, column) = m[row][column];
    return transform;
}

void add_nodes(const aiNode& node, std::optional<size_t> parent,
               std::vector<Animation::Node>& nodes) {
    const size_t index = nodes.size();
    nodes.push_back({node.mName.C_Str(), parent, transform_of(node.mTransformation), {}, {}, {}});
    for (unsigned c = 0; c < node.mNumChildren; ++c)
        add_nodes(*node.mChildren[c], index, nodes);
}

template <typename From, typename Convert>
auto keys_of(const From* keys, unsigned count, double ticks, const Convert& convert) {
    std::vector<Key<decltype(convert(keys->mValue))>> list;
    for (unsigned k = 0; k < count; ++k)
        list.push_back({static_cast<float>(keys[k].mTime / ticks), convert(keys[k].mValue)});
    return list;
}

std::string name_of(const aiScene& scene, unsigned animation) {
    return scene.mAnimations[animation]->mName.C_Str();
}

unsigned choose(const aiScene& scene, const AnimationChoice& which, const std::string& place,
                const std::string& file) {
    const unsigned count = scene.mNumAnimations;
    if (count == 0)
        throw Failure(place + ": " + file + " has no animation");
    if (const auto* number = std::get_if<uint64_t>(&which)) {
        if (*number < count)
            return static_cast<unsigned>(*number);
        throw Failure(place + " is " + std::to_string(*number) + ", range is [0, " +
                      std::to_string(count - 1) + "]: " + file + " has no other");
    }
    const std::string& name = std::get<std::string>(which);
    std::vector<std::string> names;
    for (unsigned a = 0; a < count; ++a) {
        names.push_back(name_of(scene, a));
        if (names.back() == name)
            return a;
    }
    throw Failure(place + " is \"" + name + "\", which " + file +
                  " does not have; the nearest is \"" + std::string(nearest(name, names)) + "\"");
}
#endif

} // namespace

Vector3f sample(const std::vector<Key<Vector3f>>& keys, float time) {
    return sample_keys(keys, time, [](const Vector3f& a, const Vector3f& b, float share) {
        return Vector3f(a + share * (b - a));
    });
}

Quaternionf sample(const std::vector<Key<Quaternionf>>& keys, float time) {
    return sample_keys(keys, time, [](const Quaternionf& a, const Quaternionf& b, float share) {
        return a.slerp(share, b);
    });
}

#ifdef PLAIT_WITH_ASSIMP
Animation::Animation(const std::string& file, const AnimationChoice& which,
                     const std::string& place) {
    Assimp::Importer importer;
    const aiScene* const scene = importer.ReadFile(file, 0);
    if (!scene || !scene->mRootNode)
        throw Failure(place + ": " + file + ": " + importer.GetErrorString());
    const unsigned chosen = choose(*scene, which, place, file);
    const aiAnimation& animation = *scene->mAnimations[chosen];
    const double ticks = animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 1000;
    name_ = name_of(*scene, chosen).empty() ? std::to_string(chosen) : name_of(*scene, chosen);
    seconds_ = static_cast<float>(animation.mDuration / ticks);
    add_nodes(*scene->mRootNode, {}, nodes_);
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
        const aiNodeAnim& channel = *animation.mChannels[c];
        const auto node = std::ranges::find(nodes_, channel.mNodeName.C_Str(), &Node::name);
        if (node == nodes_.end())
            continue;
        node->move = keys_of(channel.mPositionKeys, channel.mNumPositionKeys, ticks, vector_of);
        node->turn = keys_of(channel.mRotationKeys, channel.mNumRotationKeys, ticks, quaternion_of);
        node->scale = keys_of(channel.mScalingKeys, channel.mNumScalingKeys, ticks, vector_of);
    }
}
#else
Animation::Animation(const std::string& file, const AnimationChoice&, const std::string& place) {
    throw Failure(place + ": " + file +
                  ": this plait-simulate was built without assimp, which reads animations");
}
#endif

std::optional<size_t> Animation::find(const std::string& name) const {
    const auto exact = std::ranges::find(nodes_, name, &Node::name);
    const auto found = exact != nodes_.end()
                           ? exact
                           : std::ranges::find(nodes_, lower(name),
                                               [](const Node& node) { return lower(node.name); });
    if (found == nodes_.end())
        return {};
    return static_cast<size_t>(found - nodes_.begin());
}

Affine3f Animation::world(size_t index, float time) const {
    const float at = seconds_ > 0 ? std::fmod(std::max(time, 0.0f), seconds_) : 0.0f;
    Affine3f world = Affine3f::Identity();
    for (std::optional<size_t> node = index; node; node = nodes_[*node].parent) {
        const Node& here = nodes_[*node];
        Affine3f local = here.rest;
        if (!here.move.empty() && !here.turn.empty() && !here.scale.empty())
            local = Eigen::Translation3f(sample(here.move, at)) * sample(here.turn, at) *
                    Eigen::Scaling(sample(here.scale, at));
        world = local * world;
    }
    return world;
}

} // namespace simulate
