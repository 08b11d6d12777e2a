// A stage's view of a buffer: every access is checked, so the backend that specifies what a stage
// does also says when a dispatch makes no sense.
#pragma once

#include "base/format.hpp"

#include <cstddef>
#include <stdexcept>

namespace plait::reference {

// Thrown by views and stages, turned into PLAIT_INVALID_ARGUMENT by Device::submit. It never leaves
// the backend; a value would have to pass through every formula.
struct BadDispatch : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <typename T> class View {
  public:
    View() = default;
    View(T* data, size_t size, const char* argument)
        : data_(data), size_(size), argument_(argument) {}

    size_t size() const { return size_; }
    View<const T> as_const() const { return {data_, size_, argument_}; }

    T& operator[](size_t index) const {
        if (index >= size_)
            throw BadDispatch(
                format("%s: element %zu of %zu does not exist", argument_, index, size_));
        return data_[index];
    }

  private:
    T* data_ = nullptr;
    size_t size_ = 0;
    const char* argument_ = "";
};

} // namespace plait::reference
