// An animation of a glTF file: where its nodes are at any time.
#pragma once

#include "common.hpp"

#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace simulate {

template <typename T> struct Key {
    float time; // s
    T value;
};

// One of a file: its number, from 0, or its name.
using AnimationChoice = std::variant<uint64_t, std::string>;

class Animation {
  public:
    // `place`: where the scene says which, for messages. Throws Failure.
    Animation(const std::string& file, const AnimationChoice& which, const std::string& place);

    const std::string& name() const { return name_; }
    float seconds() const { return seconds_; }
    // The node with this name, in any case.
    std::optional<size_t> find(const std::string& name) const;
    // From a node's frame to the file's, in the file's units. After its end it begins again.
    Eigen::Affine3f world(size_t node, float time) const;

    struct Node {
        std::string name;
        std::optional<size_t> parent;
        Eigen::Affine3f
            rest; // in the parent's frame; what follows is used instead where it has keys
        std::vector<Key<Eigen::Vector3f>> move, scale;
        std::vector<Key<Eigen::Quaternionf>> turn;
    };

  private:
    std::string name_;
    float seconds_ = 0.0f;
    std::vector<Node> nodes_; // parents first
};

// Of keys in order of time: between two linear, of rotations by slerp; before the first and after the last
// these.
Eigen::Vector3f sample(const std::vector<Key<Eigen::Vector3f>>& keys, float time);
Eigen::Quaternionf sample(const std::vector<Key<Eigen::Quaternionf>>& keys, float time);

} // namespace simulate
