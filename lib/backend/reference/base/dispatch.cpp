#include "backend/reference/base/dispatch.hpp"

#include "backend/reference/base/buffer.hpp"
#include "backend/reference/base/shape.hpp"
#include "backend/reference/base/stages.hpp"

#include <cstring>
#include <type_traits>

namespace plait::reference {
namespace {

template <typename T> constexpr plait_element element_of = PLAIT_ELEMENT_FLOAT;
template <> constexpr plait_element element_of<Vec4> = PLAIT_ELEMENT_FLOAT4;
template <> constexpr plait_element element_of<uint32_t> = PLAIT_ELEMENT_UINT;

constexpr const char* element_names[] = {"float", "float4", "uint"};

// Hands out a dispatch's buffers in the order of the stage's arguments.
class Binder {
  public:
    Binder(const plait_dispatch& dispatch, const Shape& shape)
        : dispatch_(dispatch), shape_(shape) {}

    template <typename T> void bind(View<T>& view, BufferName name, const char* argument) {
        using Element = std::remove_const_t<T>;
        const size_t needed = shape_.elements(name);
        Buffer* buffer = next(argument);
        if (!buffer && needed > 0)
            throw BadDispatch(format("%s is null", argument));
        if (!buffer)
            return;
        if (buffer->element() != element_of<Element>)
            throw BadDispatch(format("%s: buffer '%s' holds %s, not %s", argument, buffer->name(),
                                     element_names[buffer->element()],
                                     element_names[element_of<Element>]));
        if (buffer->size() < needed)
            throw BadDispatch(format("%s: buffer '%s' has %zu elements, the dispatch needs %zu",
                                     argument, buffer->name(), buffer->size(), needed));
        view = {buffer->data<Element>(), buffer->size(), argument};
    }

    void finish() const {
        if (next_ != dispatch_.buffer_count)
            throw BadDispatch(
                format("%u buffers, the stage takes %u", dispatch_.buffer_count, next_));
    }

  private:
    Buffer* next(const char* argument) {
        if (next_ >= dispatch_.buffer_count)
            throw BadDispatch(format("%s: only %u buffers are given", argument, next_));
        return reinterpret_cast<Buffer*>(dispatch_.buffers[next_++]);
    }

    const plait_dispatch& dispatch_;
    const Shape& shape_;
    uint32_t next_ = 0;
};

template <typename Params> Params copy_params(const plait_dispatch& dispatch) {
    if (!dispatch.params || dispatch.params_size != sizeof(Params))
        throw BadDispatch(format("params of %u bytes, the stage takes %zu",
                                 dispatch.params ? dispatch.params_size : 0, sizeof(Params)));
    Params params;
    std::memcpy(&params, dispatch.params, sizeof params);
    return params;
}

// perform_X: the body between PLAIT_STAGE and PLAIT_STAGE_END binds X's arguments one by one.
#define PLAIT_BIND(name) binder.bind(args.name, BufferName::name, #name);
#define PLAIT_BIND_READ(name) PLAIT_BIND(name)
#define PLAIT_BIND_WRITE(name) PLAIT_BIND(name)
#define PLAIT_BIND_READWRITE(name) PLAIT_BIND(name)
#define PLAIT_BIND_LOCAL(name)

#define PLAIT_STAGE(name, space, params_type, summary)                                             \
    void perform_##name(const plait_dispatch& dispatch) {                                          \
        const auto params = copy_params<params_type>(dispatch);                                    \
        const Shape shape(dispatch, PLAIT_SPACE_##space, params);                                  \
        Binder binder(dispatch, shape);                                                            \
        name##_args args;
#define PLAIT_ARG(stage, name, element, access) PLAIT_BIND_##access(name)
#define PLAIT_STAGE_END(name)                                                                      \
    binder.finish();                                                                               \
    name(dispatch.item_count, params, args);                                                       \
    }
#include <plait/stages.def>

struct Entry {
    const char* name;
    void (*perform)(const plait_dispatch&);
};

constexpr Entry entries[PLAIT_STAGE_COUNT] = {
#define PLAIT_STAGE(name, space, params_type, summary) {#name, perform_##name},
#include <plait/stages.def>
};

} // namespace

Status perform(const plait_dispatch& dispatch) {
    if (static_cast<uint32_t>(dispatch.stage) >= PLAIT_STAGE_COUNT)
        return Error{PLAIT_INVALID_ARGUMENT, format("stage %u does not exist, there are %u",
                                                    static_cast<uint32_t>(dispatch.stage),
                                                    static_cast<uint32_t>(PLAIT_STAGE_COUNT))};
    const Entry& entry = entries[dispatch.stage];
    try {
        entry.perform(dispatch);
    } catch (const BadDispatch& bad) {
        return Error{PLAIT_INVALID_ARGUMENT, format("stage %s: %s", entry.name, bad.what())};
    }
    return {};
}

} // namespace plait::reference
