#include "motion.hpp"
#include "common.hpp"
#include "common/json_reader.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

namespace simulate {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

// ---- named motions: each starts from rest and repeats or goes on for as long as it is asked

float wave(float hertz, float time) {
    return std::sin(2.0f * pi * hertz * time);
}

// 0 before `from`, 1 after `to`, smooth in between.
float ease(float time, float from, float to) {
    const float s = std::clamp((time - from) / (to - from), 0.0f, 1.0f);
    return s * s * (3.0f - 2.0f * s);
}

HeadState still(float) {
    return {};
}

HeadState shake(float time) {
    HeadState head;
    head.yaw = 32.0f * ease(time, 0.0f, 0.4f) * wave(1.3f, time);
    return head;
}

// To one side, to the other and back, every 4 s.
HeadState turn(float time) {
    const float t = std::fmod(time, 4.0f);
    HeadState head;
    head.yaw = 55.0f * (ease(t, 0.3f, 0.8f) - 2.0f * ease(t, 1.5f, 2.2f) + ease(t, 3.0f, 3.5f));
    return head;
}

HeadState nod(float time) {
    HeadState head;
    head.pitch = 18.0f * ease(time, 0.0f, 0.4f) * wave(0.9f, time);
    return head;
}

// Shakes for 2 s, stops, turns to one side and back; every 4 s.
HeadState shake_and_turn(float time) {
    const float t = std::fmod(time, 4.0f);
    const float shaking = ease(t, 0.0f, 0.3f) * (1.0f - ease(t, 1.6f, 2.0f));
    HeadState head;
    head.yaw =
        30.0f * shaking * wave(1.4f, t) + 50.0f * (ease(t, 2.3f, 2.7f) - ease(t, 3.2f, 3.7f));
    head.roll = 5.0f * shaking * wave(0.7f, t);
    return head;
}

// In place, as on a treadmill: two steps a second lift the head, one stride sways it.
HeadState walk(float time) {
    const float start = ease(time, 0.0f, 0.5f);
    HeadState head;
    head.x = 0.020f * start * wave(1.0f, time);
    head.y = 0.025f * start * 0.5f * (1.0f - std::cos(4.0f * pi * time));
    head.yaw = 4.0f * start * wave(1.0f, time);
    head.pitch = 2.0f * start * wave(2.0f, time);
    return head;
}

using Formula = HeadState (*)(float);
struct Named {
    const char* name;
    Formula formula;
};
constexpr Named named_motions[] = {{"still", still},
                                   {"shake", shake},
                                   {"turn", turn},
                                   {"nod", nod},
                                   {"shake_and_turn", shake_and_turn},
                                   {"walk", walk}};

class FormulaMotion : public Motion {
  public:
    explicit FormulaMotion(Formula formula) : formula_(formula) {}
    HeadState at(float time) const override { return formula_(time); }

  private:
    Formula formula_;
};

// ---- keyframes

constexpr std::array<const char*, 7> columns{"time", "yaw", "pitch", "roll", "x", "y", "z"};
constexpr std::array<float HeadState::*, 6> channels{&HeadState::yaw,  &HeadState::pitch,
                                                     &HeadState::roll, &HeadState::x,
                                                     &HeadState::y,    &HeadState::z};

// Cubic Hermite with slopes from the neighbours, which may be unevenly spaced.
float catmull_rom(const std::array<float, 4>& time, const std::array<float, 4>& value, float t) {
    const auto slope = [&](int i) {
        return (value[i + 1] - value[i - 1]) / (time[i + 1] - time[i - 1]);
    };
    const float span = time[2] - time[1], s = (t - time[1]) / span;
    const float from = slope(1) * span, to = slope(2) * span, rise = value[2] - value[1];
    return value[1] +
           s * (from + s * (3.0f * rise - 2.0f * from - to + s * (from + to - 2.0f * rise)));
}

class KeyframedMotion : public Motion {
  public:
    explicit KeyframedMotion(std::vector<Keyframe> keys) : keys_(std::move(keys)) {}

    HeadState at(float time) const override {
        if (time <= keys_.front().time)
            return keys_.front().head;
        if (time >= keys_.back().time)
            return keys_.back().head;
        const auto next =
            std::upper_bound(keys_.begin(), keys_.end(), time,
                             [](float t, const Keyframe& key) { return t < key.time; });
        return between(next - keys_.begin(), time);
    }

  private:
    // Beyond the ends the neighbour is the end itself, held for as long as the span inside.
    Keyframe neighbour(ptrdiff_t index) const {
        const auto last = static_cast<ptrdiff_t>(keys_.size()) - 1;
        if (index < 0)
            return {2.0f * keys_[0].time - keys_[1].time, keys_[0].head};
        if (index > last)
            return {2.0f * keys_[last].time - keys_[last - 1].time, keys_[last].head};
        return keys_[index];
    }

    HeadState between(ptrdiff_t next, float time) const {
        std::array<Keyframe, 4> near;
        std::array<float, 4> times{}, values{};
        for (int i = 0; i < 4; ++i) {
            near[i] = neighbour(next - 2 + i);
            times[i] = near[i].time;
        }
        HeadState head;
        for (const auto channel : channels) {
            for (int i = 0; i < 4; ++i)
                values[i] = near[i].head.*channel;
            head.*channel = catmull_rom(times, values, time);
        }
        return head;
    }

    std::vector<Keyframe> keys_;
};

void set_column(Keyframe& key, size_t column, float value) {
    if (column == 0)
        key.time = value;
    else
        key.head.*channels[column - 1] = value;
}

size_t column_of(const std::string& name, const std::string& place) {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end())
        throw Failure(place + ": column \"" + name +
                      "\" is none of time, yaw, pitch, roll, x, y, z");
    return static_cast<size_t>(found - columns.begin());
}

std::vector<size_t> columns_of(const std::vector<std::string>& names, const std::string& place) {
    std::vector<size_t> order;
    for (const std::string& name : names) {
        const size_t column = column_of(name, place);
        if (std::find(order.begin(), order.end(), column) != order.end())
            throw Failure(place + ": column \"" + name + "\" stands here twice");
        order.push_back(column);
    }
    return order;
}

std::string trimmed(const std::string& cell) {
    const size_t first = cell.find_first_not_of(" \t\r");
    return first == std::string::npos
               ? ""
               : cell.substr(first, cell.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');)
        cells.push_back(trimmed(cell));
    return cells;
}

float number_in(const std::string& cell, const std::string& place) {
    size_t used = 0;
    float number = NAN;
    try {
        number = std::stof(cell, &used);
    } catch (const std::exception&) {
        used = 0;
    }
    if (used == 0 || used != cell.size() || !std::isfinite(number))
        throw Failure(place + ": \"" + cell + "\" is not a finite number");
    return number;
}

Keyframe read_row(const std::vector<std::string>& cells, const std::vector<size_t>& order,
                  const std::string& place) {
    if (cells.size() != order.size())
        throw Failure(place + ": " + std::to_string(cells.size()) + " values in a table of " +
                      std::to_string(order.size()) + " columns");
    Keyframe key{};
    for (size_t i = 0; i < cells.size(); ++i)
        set_column(key, order[i], number_in(cells[i], place));
    return key;
}

std::vector<Keyframe> read_csv(const std::string& file) {
    std::ifstream stream(file);
    if (!stream)
        throw Failure(file + ": cannot be opened");
    std::vector<size_t> order;
    std::vector<Keyframe> keys;
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
        const std::string place = file + ":" + std::to_string(number);
        const std::vector<std::string> cells = cells_of(line);
        if (trimmed(line).empty() || cells[0].starts_with('#'))
            continue;
        if (!order.empty())
            keys.push_back(read_row(cells, order, place));
        else
            order = columns_of(cells, place);
    }
    return keys;
}

std::vector<Keyframe> read_json_keys(const std::string& file) {
    Origin origin{file, Json::object(), {}};
    const Json document = read_json(origin);
    JsonReader top(document, origin);
    const Json* list = top.value("keyframes");
    if (!list || !list->is_array())
        top.fail("keyframes", "is missing or not a list");
    top.finish();
    std::vector<Keyframe> keys;
    for (size_t i = 0; i < list->size(); ++i) {
        JsonReader in = top.element(*list, i, "keyframes");
        keys.push_back(read_keyframe(in));
    }
    return keys;
}

std::vector<Keyframe> checked(std::vector<Keyframe> keys, const std::string& file) {
    if (const std::string problem = keyframe_problem(keys); !problem.empty())
        throw Failure(file + ": " + problem);
    return keys;
}

} // namespace

Keyframe read_keyframe(JsonReader& in) {
    Keyframe key{};
    if (!in.number("time", key.time, 0, 1e6))
        in.fail("time", "is missing");
    for (size_t c = 0; c < channels.size(); ++c)
        in.number(columns[c + 1], key.head.*channels[c], -1e6, 1e6);
    in.finish();
    return key;
}

std::string keyframe_problem(const std::vector<Keyframe>& keys) {
    if (keys.empty())
        return "no keyframes";
    for (size_t i = 1; i < keys.size(); ++i)
        if (!(keys[i].time > keys[i - 1].time))
            return "keyframe " + std::to_string(i) + " at " + std::to_string(keys[i].time) +
                   " s does not come after the one before, at " + std::to_string(keys[i - 1].time) +
                   " s";
    return "";
}

std::unique_ptr<Motion> make_keyframed(std::vector<Keyframe> keys) {
    return std::make_unique<KeyframedMotion>(std::move(keys));
}

std::unique_ptr<Motion> make_motion(const std::string& name) {
    std::vector<std::string> names;
    for (const Named& motion : named_motions) {
        if (name == motion.name)
            return std::make_unique<FormulaMotion>(motion.formula);
        names.emplace_back(motion.name);
    }
    if (name.ends_with(".csv"))
        return make_keyframed(checked(read_csv(name), name));
    if (name.ends_with(".json"))
        return make_keyframed(checked(read_json_keys(name), name));
    throw Failure("motion \"" + name +
                  "\" is neither a .csv or .json file nor a known name; the nearest is \"" +
                  std::string(nearest(name, names)) + "\"");
}

plait_pose to_pose(const HeadState& head, const std::array<float, 3>& pivot) {
    using Eigen::AngleAxisf, Eigen::Vector3f;
    const float radians = pi / 180.0f;
    const Eigen::Quaternionf turn = AngleAxisf(head.yaw * radians, Vector3f::UnitY()) *
                                    AngleAxisf(head.pitch * radians, Vector3f::UnitX()) *
                                    AngleAxisf(head.roll * radians, Vector3f::UnitZ());
    const Vector3f centre(pivot[0], pivot[1], pivot[2]);
    const Vector3f move = centre + Vector3f(head.x, head.y, head.z) - turn * centre;
    return {{turn.x(), turn.y(), turn.z(), turn.w()}, {move.x(), move.y(), move.z()}};
}

} // namespace simulate
