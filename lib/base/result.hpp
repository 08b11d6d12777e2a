// Errors as values: what the caller can do (plait_result) and the sentence that says what happened.
#pragma once

#include <plait/plait.h>

#include <string>
#include <utility>
#include <variant>

namespace plait {

struct Error {
    plait_result code = PLAIT_INTERNAL;
    std::string message;
};

// A value or an Error.
template <typename T> class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }
    T& value() { return std::get<0>(state_); }
    const T& value() const { return std::get<0>(state_); }
    T& operator*() { return value(); }
    const T& operator*() const { return value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }
    const Error& error() const { return std::get<1>(state_); }

  private:
    std::variant<T, Error> state_;
};

// Success or an Error.
class [[nodiscard]] Status {
  public:
    Status() = default;
    Status(Error error) : error_(std::move(error)) {}

    bool ok() const { return error_.code == PLAIT_OK; }
    explicit operator bool() const { return ok(); }
    const Error& error() const { return error_; }

  private:
    Error error_{PLAIT_OK, {}};
};

} // namespace plait

// Return the error of `expression` (a Status or Result) to the caller.
#define PLAIT_TRY(expression)                                                                      \
    do {                                                                                           \
        if (auto&& plait_try_ = (expression); !plait_try_.ok())                                    \
            return plait_try_.error();                                                             \
    } while (false)
