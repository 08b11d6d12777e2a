// Owners of OpenCL objects: retained on copy, released at the end.
#pragma once

#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#ifdef __APPLE__
#include <OpenCL/cl.h>
#else
#include <CL/cl.h>
#endif

#include <utility>

namespace plait::opencl {

template <typename T, auto retain, auto release> class Handle {
  public:
    Handle() = default;
    explicit Handle(T owned) : object_(owned) {}
    Handle(const Handle& other) : object_(other.object_) {
        if (object_)
            retain(object_);
    }
    Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    Handle& operator=(Handle other) noexcept {
        std::swap(object_, other.object_);
        return *this;
    }
    ~Handle() {
        if (object_)
            release(object_);
    }

    // Shares an object that someone else owns.
    static Handle share(T borrowed) {
        retain(borrowed);
        return Handle(borrowed);
    }

    T get() const { return object_; }
    explicit operator bool() const { return object_ != nullptr; }

  private:
    T object_ = nullptr;
};

using Context = Handle<cl_context, clRetainContext, clReleaseContext>;
using Queue = Handle<cl_command_queue, clRetainCommandQueue, clReleaseCommandQueue>;
using Program = Handle<cl_program, clRetainProgram, clReleaseProgram>;
using Kernel = Handle<cl_kernel, clRetainKernel, clReleaseKernel>;
using Memory = Handle<cl_mem, clRetainMemObject, clReleaseMemObject>;
using Event = Handle<cl_event, clRetainEvent, clReleaseEvent>;

// The driver calls that can fail while a simulation runs, gathered so that a test can make one fail
// on a device of its own.
struct Calls {
    decltype(&clCreateBuffer) create_buffer = clCreateBuffer;
    decltype(&clEnqueueNDRangeKernel) enqueue_kernel = clEnqueueNDRangeKernel;
    decltype(&clEnqueueReadBuffer) enqueue_read = clEnqueueReadBuffer;
    decltype(&clEnqueueWriteBuffer) enqueue_write = clEnqueueWriteBuffer;
    decltype(&clFlush) flush = clFlush;
    decltype(&clFinish) finish = clFinish;
};

} // namespace plait::opencl
