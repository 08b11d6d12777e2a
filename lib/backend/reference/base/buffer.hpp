// Memory of the reference backend: floats are kept as doubles, so that a chain of stages rounds to
// float32 only where the caller writes and reads.
#pragma once

#include "backend/reference/base/math.hpp"

#include <plait/plait_backend.h>

#include <cstdint>
#include <memory_resource>
#include <string>
#include <variant>
#include <vector>

namespace plait::reference {

class Buffer {
  public:
    Buffer(const plait_buffer_desc& desc, std::pmr::memory_resource* memory);

    plait_element element() const { return static_cast<plait_element>(storage_.index()); }
    size_t size() const;
    const char* name() const { return name_.c_str(); }

    void write(size_t first, size_t count, const void* src);
    void read(size_t first, size_t count, void* dst) const;

    template <typename T> T* data() { return std::get<std::pmr::vector<T>>(storage_).data(); }

  private:
    // In the order of plait_element.
    using Storage =
        std::variant<std::pmr::vector<double>, std::pmr::vector<Vec4>, std::pmr::vector<uint32_t>>;
    static Storage make_storage(const plait_buffer_desc& desc, std::pmr::memory_resource* memory);

    std::pmr::string name_;
    Storage storage_;
};

} // namespace plait::reference
