#include "path.hpp"

#include <utility>

namespace plait_generator {
namespace {

std::vector<double> running_length(const Path& path) {
    std::vector<double> at{0};
    for (size_t i = 1; i < path.size(); ++i)
        at.push_back(at.back() + length(path[i] - path[i - 1]));
    return at;
}

// Finds values in an ascending sequence.
class Lookup {
  public:
    explicit Lookup(const std::vector<double>& from) : from_(from) {}

    // Index and share of the step after it; calls must ask for ascending values.
    std::pair<size_t, double> find(double wanted) {
        while (i_ + 2 < from_.size() && from_[i_ + 1] < wanted)
            ++i_;
        const double span = from_[i_ + 1] - from_[i_];
        return {i_, span > 0 ? std::clamp((wanted - from_[i_]) / span, 0.0, 1.0) : 0};
    }

  private:
    const std::vector<double>& from_;
    size_t i_ = 0;
};

Path points_at(const Path& path, const std::vector<double>& lengths,
               const std::vector<double>& places) {
    Lookup lookup(lengths);
    Path out;
    for (const double place : places) {
        const auto [i, share] = lookup.find(place);
        out.push_back(mix(path[i], path[i + 1], share));
    }
    return out;
}

// Places along the path that would be equally far apart if it were straight between the present
// ones.
std::vector<double> evened(const std::vector<double>& places, const Path& points) {
    const std::vector<double> chords = running_length(points);
    Lookup lookup(chords);
    std::vector<double> out;
    for (size_t k = 0; k < places.size(); ++k) {
        const double wanted =
            chords.back() * static_cast<double>(k) / static_cast<double>(places.size() - 1);
        const auto [i, share] = lookup.find(wanted);
        out.push_back(mix(places[i], places[i + 1], share));
    }
    return out;
}

} // namespace

double path_length(const Path& path) {
    return running_length(path).back();
}

Vec3 tangent(const Path& path, size_t i) {
    return unit(path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0]);
}

Path resample(const Path& path, size_t count, int rounds) {
    const std::vector<double> lengths = running_length(path);
    std::vector<double> places;
    for (size_t k = 0; k < count; ++k)
        places.push_back(lengths.back() * static_cast<double>(k) / static_cast<double>(count - 1));
    Path points = points_at(path, lengths, places);
    for (int round = 0; round < rounds; ++round) {
        places = evened(places, points);
        points = points_at(path, lengths, places);
    }
    points.back() = path.back();
    return points;
}

std::vector<Vec3> untwisted_normals(const Path& path, Vec3 first) {
    std::vector<Vec3> normals;
    for (size_t i = 0; i < path.size(); ++i) {
        const Vec3 t = tangent(path, i), before = i > 0 ? normals.back() : first;
        const Vec3 fallback = std::abs(t.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        normals.push_back(unit(reject(before, t), unit(reject(fallback, t))));
    }
    return normals;
}

Path wind(const Path& axis, const Helix& helix) {
    const std::vector<Vec3> normals = untwisted_normals(axis, {0, 0, 1});
    const std::vector<double> at = running_length(axis);
    Path out;
    for (size_t i = 0; i < axis.size(); ++i) {
        const double turns = helix.phase + helix.handedness * at[i] / helix.pitch;
        const double radius = helix.radius * smoothstep(0, helix.onset, at[i]);
        const Vec3 across = cross(tangent(axis, i), normals[i]);
        out.push_back(axis[i] +
                      radius * (cos_turns(turns) * normals[i] + sin_turns(turns) * across));
    }
    return out;
}

Vec3 hermite(Vec3 a, Vec3 a_way, Vec3 b, Vec3 b_way, double t) {
    const double u = 1 - t;
    return u * u * (1 + 2 * t) * a + t * u * u * a_way + t * t * (1 + 2 * u) * b -
           t * t * u * b_way;
}

void push_out(Path& path, const Field& field, double clearance, double onset) {
    const std::vector<double> at = running_length(path);
    for (size_t i = 1; i < path.size(); ++i) {
        const double wanted = clearance * std::min(at[i] / onset, 1.0);
        for (int tries = 0; tries < 4; ++tries) {
            const Surroundings here = field.at(path[i]);
            if (here.distance >= wanted)
                break;
            path[i] += (wanted - here.distance) * here.normal;
        }
    }
}

} // namespace plait_generator
