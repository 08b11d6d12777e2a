// The caller's allocator as a std::pmr::memory_resource, and objects that live in it.
#pragma once

#include <plait/plait.h>

#include <cstddef>
#include <memory>
#include <memory_resource>
#include <new>
#include <utility>

namespace plait {

// A NULL from the caller's function becomes std::bad_alloc; the wall turns that into OUT_OF_MEMORY.
class Memory final : public std::pmr::memory_resource {
  public:
    explicit Memory(const plait_allocator& allocator) : allocator_(allocator) {}
    const plait_allocator& allocator() const { return allocator_; }

  private:
    void* do_allocate(size_t size, size_t alignment) override {
        void* memory = allocator_.allocate
                           ? allocator_.allocate(size, alignment, allocator_.user)
                           : ::operator new(size, std::align_val_t(alignment), std::nothrow);
        if (!memory)
            throw std::bad_alloc();
        return memory;
    }
    void do_deallocate(void* memory, size_t size, size_t alignment) override {
        if (allocator_.release)
            allocator_.release(memory, size, alignment, allocator_.user);
        else
            ::operator delete(memory, std::align_val_t(alignment));
    }
    bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override {
        return this == &other;
    }

    plait_allocator allocator_;
};

// Deletes an object made by make_in from the memory it came from.
template <typename T> struct DeleteIn {
    std::pmr::memory_resource* memory = nullptr;
    void operator()(T* object) const {
        object->~T();
        memory->deallocate(object, sizeof(T), alignof(T));
    }
};
template <typename T> using PointerIn = std::unique_ptr<T, DeleteIn<T>>;

template <typename T, typename... Arguments>
PointerIn<T> make_in(std::pmr::memory_resource* memory, Arguments&&... arguments) {
    void* const place = memory->allocate(sizeof(T), alignof(T));
    try {
        return PointerIn<T>(new (place) T(std::forward<Arguments>(arguments)...), {memory});
    } catch (...) {
        memory->deallocate(place, sizeof(T), alignof(T));
        throw;
    }
}

// The same of one that several hold, in whose memory their number is, too.
template <typename T, typename... Arguments>
std::shared_ptr<T> share_in(std::pmr::memory_resource* memory, Arguments&&... arguments) {
    return std::allocate_shared<T>(std::pmr::polymorphic_allocator<T>(memory),
                                   std::forward<Arguments>(arguments)...);
}

} // namespace plait
