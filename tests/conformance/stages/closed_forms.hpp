// What a stage must give on inputs small enough to work out by hand: the check of the reference,
// run on every other device too.
#pragma once

#include "case.hpp"
#include "subjects.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace plait::conformance {

// Runs single stages on a device, failing the running test where that fails.
class Bench {
  public:
    explicit Bench(Subject& subject) : subject_(subject) {}

    template <typename P>
    cases::Outputs run(plait_stage stage, uint32_t items, uint32_t width, const P& params,
                       std::vector<cases::Array> buffers) {
        cases::Setup setup;
        setup.name = plait_stage_describe(stage)->name;
        setup.items = items;
        setup.width = width;
        setup.buffers = std::move(buffers);
        return run(stage, setup.with(params));
    }

  private:
    cases::Outputs run(plait_stage stage, const cases::Setup& setup);

    Subject& subject_;
};

struct ClosedForm {
    const char* name;
    void (*check)(Bench&);
};
#define PLAIT_CLOSED_FORM(name)                                                                    \
    { #name, name }
const std::vector<ClosedForm>& strand_closed_forms();
const std::vector<ClosedForm>& grid_closed_forms();
const std::vector<ClosedForm>& energy_closed_forms();
const std::vector<ClosedForm>& air_closed_forms();
const std::vector<ClosedForm>& section_closed_forms();
const std::vector<ClosedForm>& volume_closed_forms();
const std::vector<ClosedForm>& mesh_closed_forms();

// Floats equal up to `tolerance`, with the differing element in the message.
void expect_near(const cases::Array& got, const std::vector<float>& expected,
                 double tolerance = 1e-6);

} // namespace plait::conformance
