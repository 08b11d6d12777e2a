// The devices under test: every device of every registered backend.
#pragma once

#include <plait/plait_backend.h>

#include <memory>
#include <string>
#include <vector>

namespace plait::conformance {

class Subject {
  public:
    Subject(const plait_backend_api& api, uint32_t index, const plait_device_info& info);

    const std::string& name() const { return name_; } // of a GoogleTest suite
    const plait_device_info& info() const { return info_; }
    const plait_device_api& api() const { return *api_.device; }
    // Opened at the first call, since building kernels takes seconds; null if that failed.
    plait_device* device();
    const std::string& open_error() const { return open_error_; }

  private:
    const plait_backend_api& api_;
    uint32_t index_;
    plait_device_info info_;
    std::string name_;
    std::string open_error_;
    std::shared_ptr<plait_device> device_;
};

// Those whose backend, platform or name contains `part`, in any case.
std::vector<Subject> find_subjects(const std::string& part);
// The backend called `name`, device 0; null if there is none.
std::shared_ptr<Subject> find_backend(const std::string& name);

} // namespace plait::conformance
