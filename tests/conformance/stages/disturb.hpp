// An input a little off: what the sensitivity check of every case gives a stage.
#pragma once

#include "case.hpp"

namespace plait::conformance {

// Changes word `word` of a field the way its kind asks for.
void disturb(cases::Setup& setup, const cases::Field& field, size_t word);

// Which of a strand's rows hold a component.
enum class Rows { all, last, all_but_last };

// Every `period`-th float of a buffer from `place` on, in these rows.
struct Component {
    std::string name;
    size_t buffer, place, period;
    Rows rows;
};

// Those of every buffer of floats that the stage reads, named argument.component. Left out is what
// no stage may read: padding of a layout, and the inverse mass in position_prev and
// position_prev2, which is only carried along.
std::vector<Component> components_of(const cases::Case& stage_case);

// Whether `names` has the component, by its name or by that of its argument.
bool has(const std::vector<std::string>& names, const std::string& component);

// Sets the component 1 % off in every item; positions about their strand's root, so that the shape
// is off and not the place; ratios in every other item, flags from 0 to 1 and else to 0. False if
// that changes nothing.
bool disturb(cases::Setup& setup, const cases::Case& stage_case, const Component& component);

// Puts `expected` where `got` shows only what was changed in an input: buffers that are read, and
// floats that a stage hands on as they are.
void forgive(const cases::Case& stage_case, const cases::Setup& original,
             const cases::Setup& disturbed, const cases::Outputs& expected, cases::Outputs& got);

} // namespace plait::conformance
