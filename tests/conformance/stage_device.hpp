// Single stages on every device of every backend, through plait_backend.h alone.
#pragma once

#include <plait/plait_backend.h>

#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace plait::test {

using Float4 = std::array<float, 4>;

// One device that can be opened; `label` names it in test names: letters, digits and '_'.
struct DeviceName {
    const plait_backend_api* backend;
    uint32_t index;
    std::string label;
};

inline void PrintTo(const DeviceName& name, std::ostream* out) {
    *out << name.label;
}

inline std::string test_label(const std::string& text) {
    std::string label;
    for (const char c : text)
        if (std::isalnum(static_cast<unsigned char>(c)))
            label += c;
        else if (!label.empty() && label.back() != '_')
            label += '_';
    return label;
}

inline std::vector<DeviceName> every_device() {
    std::vector<DeviceName> names;
    for (size_t b = 0; b < plait_backend_count(); ++b) {
        const plait_backend_api* backend = plait_backend_get(b);
        size_t count = 0;
        backend->enumerate(nullptr, &count);
        std::vector<plait_device_info> infos(count);
        for (plait_device_info& info : infos)
            info.struct_size = sizeof info;
        if (count > 0)
            backend->enumerate(infos.data(), &count);
        for (uint32_t i = 0; i < count; ++i)
            names.push_back({backend, i,
                             test_label(std::string(backend->name) + " " + std::to_string(i) + " " +
                                        infos[i].name)});
    }
    return names;
}

// For INSTANTIATE_TEST_SUITE_P.
inline std::string device_test_name(const ::testing::TestParamInfo<DeviceName>& device) {
    return device.param.label;
}

class StageBuffer {
  public:
    StageBuffer(plait_device* device, const plait_device_api* api, plait_element element,
                size_t count)
        : device_(device), api_(api), count_(count) {
        const plait_buffer_desc desc{element, count, "test"};
        EXPECT_EQ(api->buffer_create(device, &desc, &buffer_), PLAIT_OK) << api->last_error(device);
    }
    ~StageBuffer() { api_->buffer_destroy(device_, buffer_); }
    StageBuffer(const StageBuffer&) = delete;
    StageBuffer& operator=(const StageBuffer&) = delete;

    template <class T> void write(const std::vector<T>& data) {
        EXPECT_EQ(api_->buffer_write(device_, buffer_, 0, data.size(), data.data()), PLAIT_OK)
            << api_->last_error(device_);
    }
    template <class T> std::vector<T> read() const {
        std::vector<T> data(count_);
        EXPECT_EQ(api_->buffer_read(device_, buffer_, 0, count_, data.data()), PLAIT_OK)
            << api_->last_error(device_);
        return data;
    }
    plait_buffer* get() const { return buffer_; }

  private:
    plait_device* device_;
    const plait_device_api* api_;
    size_t count_;
    plait_buffer* buffer_ = nullptr;
};

class StageDevice {
  public:
    explicit StageDevice(const DeviceName& name, plait_open_info info = {})
        : api_(name.backend->device) {
        info.struct_size = sizeof info;
        info.device_index = name.index;
        char error[4096] = "";
        EXPECT_EQ(name.backend->open(&info, &device_, error, sizeof error), PLAIT_OK) << error;
    }
    ~StageDevice() {
        if (device_)
            api_->destroy(device_);
    }
    StageDevice(const StageDevice&) = delete;
    StageDevice& operator=(const StageDevice&) = delete;

    std::unique_ptr<StageBuffer> uints(size_t count) { return make(PLAIT_ELEMENT_UINT, count); }
    std::unique_ptr<StageBuffer> floats(size_t count) { return make(PLAIT_ELEMENT_FLOAT, count); }
    std::unique_ptr<StageBuffer> float4s(size_t count) { return make(PLAIT_ELEMENT_FLOAT4, count); }

    // `buffers` follow the stage's non-LOCAL arguments in stages.def.
    template <class Params>
    void run(plait_stage stage, size_t items, const Params& params,
             const std::vector<const StageBuffer*>& buffers, uint32_t item_width = 1) {
        std::vector<plait_buffer*> handles;
        for (const StageBuffer* buffer : buffers)
            handles.push_back(buffer ? buffer->get() : nullptr);
        const plait_dispatch dispatch{
            stage,         static_cast<uint32_t>(items),          item_width,     &params,
            sizeof params, static_cast<uint32_t>(handles.size()), handles.data(), 0};
        EXPECT_EQ(api_->submit(device_, &dispatch, 1), PLAIT_OK) << api_->last_error(device_);
    }

    plait_device_info describe() const {
        plait_device_info info{};
        info.struct_size = sizeof info;
        EXPECT_EQ(api_->describe(device_, &info), PLAIT_OK);
        return info;
    }

  private:
    std::unique_ptr<StageBuffer> make(plait_element element, size_t count) {
        return std::make_unique<StageBuffer>(device_, api_, element, count);
    }

    const plait_device_api* api_;
    plait_device* device_ = nullptr;
};

} // namespace plait::test
