// One open device: its queue, memory and kernels.
#pragma once

#include "backend/opencl/build.hpp"
#include "backend/opencl/enumerate.hpp"
#include "backend/opencl/fences.hpp"
#include "backend/opencl/flight.hpp"
#include "backend/opencl/range.hpp"
#include "backend/opencl/side_queues.hpp"
#include "backend/opencl/staging.hpp"

#include <array>
#include <bitset>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace plait::opencl {

struct Buffer {
    Memory memory;
    std::string name;
    size_t count; // elements
    size_t element_bytes;
};

// What a device is opened with, whoever made it.
struct Session {
    Candidate candidate;
    std::shared_ptr<Programs> programs; // and the cl_context they are of
    Queue queue;
    bool profile;
};

class Device {
  public:
    // `calls` are the driver's own, or a test's.
    static Result<std::unique_ptr<Device>> open(const plait_open_info& info, const Calls& calls);

    ~Device();
    const plait_device_info& info() const { return session_.candidate.info; }
    cl_command_queue queue() const { return session_.queue.get(); }
    const SideQueues& side_queues() const { return side_queues_; }
    bool supports(plait_stage stage) const;

    Result<std::unique_ptr<Buffer>> create(const plait_buffer_desc& desc);
    Status write(const Buffer& buffer, size_t first, size_t count, const void* src);
    // Does not wait, unless uploads under way take more than Staging::most_bytes.
    Status upload(const Buffer& buffer, size_t first, size_t count, const void* src);
    Status read(const Buffer& buffer, size_t first, size_t count, void* dst);
    Status read_later(const Buffer& buffer, size_t first, size_t count, void* dst) {
        return enqueue_read(buffer, first, count, dst, CL_FALSE);
    }
    Status fence(uint64_t& fence);
    Status fence_reached(uint64_t fence, bool wait, bool& reached);

    Status submit(std::span<const plait_dispatch> list);
    Status overlap(plait_overlap what);
    Status prepare(std::span<const plait_dispatch> list); // waits where there was something to do
    Status wait(); // and keeps programs in the folder as they are by now
    Status costs(plait_stage_cost* dst, bool reset);
    Status take_launches(plait_stage_launch* dst, size_t& count); // waits where dst is null

    // The failure that took the device away, once there was one.
    const std::optional<Error>& lost() const { return lost_; }
    // Keeps the sentence for last_error() and passes the code on.
    plait_result report(const Status& status);
    const std::string& last_error() const { return last_error_; }

  private:
    Device(Session session, Log log, const Calls& calls, ProgramFolder folder);

    Status take_sources(std::span<const plait_stage_source> sources);
    Variant variant_of(const plait_stage_info& stage, const plait_dispatch& dispatch) const;
    Result<const StageKernel*> kernel(const plait_stage_info& stage, const Variant& variant);
    Result<WorkRange> range_of(const plait_stage_info& stage, const plait_dispatch& dispatch,
                               const StageKernel& built) const;
    cl_command_queue work_queue() const {
        return side_queues_.open() ? side_queues_.queue() : queue();
    }
    Status enqueue_read(const Buffer& buffer, size_t first, size_t count, void* dst,
                        cl_bool blocking);
    Status enqueue(const plait_dispatch& dispatch, bool last);
    Status launch(const plait_stage_info& stage, const StageKernel& built, const WorkRange& range,
                  cl_event* event) const;
    Status warm_up(const plait_dispatch& dispatch);
    Status finish();
    void keep_changed();

    Session session_;
    Log log_;
    ProgramFolder folder_;
    Calls calls_;
    Flight flight_;
    Fences fences_;
    Staging staging_;
    SideQueues side_queues_;
    std::array<std::optional<StageText>, PLAIT_STAGE_COUNT> texts_;
    std::bitset<PLAIT_STAGE_COUNT> own_texts_; // the user's
    std::map<std::pair<plait_stage, Variant>, StageKernel> kernels_;
    std::set<std::pair<const StageKernel*, bool>> warm_; // and whether over a large grid
    std::vector<const StageKernel*> changed_; // whose program may not be in the folder as it is
    std::optional<Error> lost_;
    std::string last_error_;
};

} // namespace plait::opencl
