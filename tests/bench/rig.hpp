// A stage with its buffers, ready to run again and again.
#pragma once

#include "device.hpp"
#include "inputs.hpp"

namespace bench {

class Rig {
  public:
    Rig(Device& device, plait_stage stage, const Shape& shape);

    double run(); // seconds of one dispatch

  private:
    void add(const plait_stage_arg& arg, const std::vector<uint32_t>& contents);

    Device& device_;
    std::vector<unsigned char> params_;
    std::vector<Device::Buffer> buffers_;
    std::vector<plait_buffer*> handles_;
    plait_dispatch dispatch_{};
};

} // namespace bench
