// The model articulated, over lanes. Strands keep their own state in the lane layout and publish it to
// position and its history, which display, the inter-hair step and interop read.
#include "core/base/strand_order.hpp"
#include "core/groom/groom.hpp"
#include "core/strands/lane_part.hpp"
#include "core/strands/length_classes.hpp"

#include <utility>

namespace plait {
namespace {

constexpr uint32_t pinned = 1; // the root; the clamp is a joint

// Settings in use, each once, in the order of their first strand.
SettingsList kinds_of(std::span<const Settings> settings, std::pmr::memory_resource* memory) {
    SettingsList list(memory);
    for (const Settings& strand : settings)
        if (std::ranges::find(list, strand) == list.end())
            list.push_back(strand);
    return list;
}

LanePart::Members order_of(const ModelInput& input) {
    const StrandSet& strands = input.groom.strands;
    return order_by_root(strands.positions,
                         std::span(strands.vertex_counts).first(input.layout.guides), input.ends,
                         input.memory);
}

class LaneModel final : public Model {
  public:
    LaneModel(const Settings& settings, const ModelInput& input);

    uint32_t pinned_vertices() const override { return pinned; }
    Status prepare(Device& device, const Params& params) override;
    Status prepare_settings(Device& device, Schedule& schedule, const StepInput& at,
                            std::span<const Settings> settings) override;
    void exchange(StrandMaterialsPtr& materials) noexcept override {
        source_.materials.swap(materials);
    }
    void exchange(std::array<float, 3>& gravity) noexcept override {
        source_.gravity.swap(gravity);
    }
    void swap() noexcept override;
    void discard() override;
    void take_mean_length(float length) override { length_ = std::max(length, 1e-6f); }
    Status open(Device& device, const PartNeeds& needs) override;
    void step_first(uint32_t strands) override;
    void wake(Schedule& schedule, const StepInput& at, const Waking& waking) const override;
    size_t parts() const override { return parts_.size(); }
    Part part(size_t index, const StepInput& at) const override {
        return parts_[index]->part(at, length_);
    }
    void substep(Schedule& schedule, const StepInput& at, const FillDoors& fill) override;
    void publish(Schedule& schedule, const StepInput& at,
                 const Buffer* tangent = nullptr) const override;
    void adopt(Schedule& schedule, const StepInput& at, Changed by) const override;
    void reset(Schedule& schedule, const StepInput& at) override;
    void teleport(Schedule& schedule, const StepInput& at, const Buffer& pose) override;
    void set_off(Schedule& schedule, const StepInput& at, const Buffer& before, const Buffer& was,
                 const Buffer& next, float jump) override;
    void carry(Schedule& schedule, const StepInput& at, const plait_pose& motion) override;
    SagReport sag() const override;
    void read_settings(std::span<Settings> settings) const override;
    void list_parts(std::span<const Settings> settings,
                    std::pmr::vector<PartShape>& to) const override;
    void add_dynamic(std::pmr::vector<LaneBuffer>& to) const override;
    void add_pressure(std::pmr::vector<LaneBuffer>& to) const override;
    void add_normal_force(std::pmr::vector<LaneBuffer>& to) const override;
    Status clear_normal_force(Device& device) override;
    Status begin_history(Device& device, const Params& then) override;
    uint64_t device_bytes() const override;

  private:
    using PartPtr = std::shared_ptr<LanePart>; // a switch keeps parts whose strands stay
    // Calls visit(settings, V of the lanes, strands in the order of the lanes) for every part there
    // is with strands of these settings: by settings and by length.
    template <typename Visit>
    Status for_each_part(std::span<const Settings> settings, const Visit& visit) const;
    PartPtr make_part(const Settings& settings, uint32_t row, LanePart::Members&& members) const;
    PartPtr find_part(const Settings& settings, const LanePart::Members& members) const;
    std::pmr::vector<LanePlace> places() const;

    LaneSource source_;
    LanePart::Members order_; // of all strands
    LengthClasses classes_;
    float length_;     // m, of the mean strand
    uint32_t stepped_; // strands
    bool opened_ = false, switches_ = false;
    std::pmr::vector<PartPtr> parts_, next_parts_; // as for_each_part has them; none is empty
};

LaneModel::LaneModel(const Settings& settings, const ModelInput& input)
    : source_(input), order_(order_of(input)), classes_(source_.strands.counts, input.memory),
      length_(std::max(static_cast<float>(input.groom.shape.mean_length), 1e-6f)),
      stepped_(input.layout.guides), parts_(input.memory), next_parts_(input.memory) {
    const SettingsList all(order_.size(), settings, input.memory);
    (void)for_each_part(all, [&](const Settings& own, uint32_t row, LanePart::Members&& members) {
        parts_.push_back(make_part(own, row, std::move(members)));
        return Status{};
    });
}

template <typename Visit>
Status LaneModel::for_each_part(std::span<const Settings> settings, const Visit& visit) const {
    for (const Settings& own : kinds_of(settings, source_.memory))
        for (const uint32_t row : classes_.rows()) {
            LanePart::Members members(source_.memory);
            for (const uint32_t strand : order_)
                if (settings[strand] == own &&
                    classes_.row_of(source_.strands.counts[strand]) == row)
                    members.push_back(strand);
            if (!members.empty())
                PLAIT_TRY(visit(own, row, std::move(members)));
        }
    return {};
}

LaneModel::PartPtr LaneModel::make_part(const Settings& settings, uint32_t row,
                                        LanePart::Members&& members) const {
    auto part =
        std::allocate_shared<LanePart>(std::pmr::polymorphic_allocator<LanePart>(source_.memory),
                                       source_, settings, row, std::move(members));
    part->step_first(stepped_);
    return part;
}

void LaneModel::step_first(uint32_t strands) {
    stepped_ = strands;
    for (const PartPtr& part : parts_)
        part->step_first(strands);
}

void LaneModel::wake(Schedule& schedule, const StepInput& at, const Waking& waking) const {
    for (const PartPtr& part : parts_)
        part->wake(schedule, at, waking);
}

LaneModel::PartPtr LaneModel::find_part(const Settings& settings,
                                        const LanePart::Members& members) const {
    for (const PartPtr& part : parts_)
        if (part->settings() == settings && part->members() == members)
            return part;
    return nullptr;
}

Status LaneModel::prepare(Device& device, const Params& params) {
    source_.measure_rest(source_.rest_grid_of(params));
    for (const PartPtr& part : parts_) {
        if (!opened_)
            PLAIT_TRY(part->open(device));
        PLAIT_TRY(part->prepare(device, params));
    }
    opened_ = true;
    return {};
}

std::pmr::vector<LanePlace> LaneModel::places() const {
    std::pmr::vector<LanePlace> list(source_.layout.guides, LanePlace{}, source_.memory);
    for (const PartPtr& part : parts_)
        for (uint32_t lane = 0; lane < part->members().size(); ++lane)
            list[part->members()[lane]] = {part.get(), lane};
    return list;
}

Status LaneModel::prepare_settings(Device& device, Schedule& schedule, const StepInput& at,
                                   std::span<const Settings> settings) {
    source_.measure_rest(source_.rest_grid_of(at.params));
    const auto from = places();
    const auto take_over = [&](const Settings& own, uint32_t row,
                               LanePart::Members&& members) -> Status {
        PartPtr part = find_part(own, members);
        if (!part) {
            part = make_part(own, row, std::move(members));
            PLAIT_TRY(part->take_over(device, schedule, at, from));
        }
        next_parts_.push_back(std::move(part));
        return {};
    };
    PLAIT_TRY(for_each_part(settings, take_over));
    switches_ = true;
    return {};
}

void LaneModel::list_parts(std::span<const Settings> settings,
                           std::pmr::vector<PartShape>& to) const {
    (void)for_each_part(settings, [&](const Settings& own, uint32_t row,
                                      LanePart::Members&& members) {
        const auto is_stepped = [&](uint32_t strand) { return strand < stepped_; };
        to.push_back({own, static_cast<uint32_t>(std::ranges::count_if(members, is_stepped)), row});
        return Status{};
    });
}

void LaneModel::swap() noexcept {
    if (switches_)
        std::swap(parts_, next_parts_);
    else
        for (const PartPtr& part : parts_)
            part->swap();
}

void LaneModel::discard() {
    switches_ = false;
    next_parts_.clear();
    for (const PartPtr& part : parts_)
        part->discard();
}

Status LaneModel::open(Device& device, const PartNeeds& needs) {
    const PartNeeds before =
        std::exchange(source_.needs, needs); // of parts that are made later, too
    Status status;
    for (const PartPtr& part : parts_)
        if (status)
            status = part->open_doors(device);
    if (!status)
        source_.needs = before;
    for (const PartPtr& part : parts_)
        part->close_doors();
    return status;
}

void LaneModel::substep(Schedule& schedule, const StepInput& at, const FillDoors& fill) {
    for (size_t i = 0; i < parts_.size(); ++i)
        if (parts_[i]->settings().substeps == at.substeps) {
            const Part seen = part(i, at);
            parts_[i]->substep(schedule, at, seen, fill(seen));
        }
}

void LaneModel::publish(Schedule& schedule, const StepInput& at, const Buffer* tangent) const {
    for (const PartPtr& part : parts_)
        part->publish(schedule, at, tangent);
}

void LaneModel::adopt(Schedule& schedule, const StepInput& at, Changed by) const {
    for (const PartPtr& part : parts_)
        part->adopt(schedule, at, by);
}

void LaneModel::reset(Schedule& schedule, const StepInput& at) {
    for (const PartPtr& part : parts_)
        part->reset(schedule, at);
    publish(schedule, at);
}

void LaneModel::teleport(Schedule& schedule, const StepInput& at, const Buffer& pose) {
    for (const PartPtr& part : parts_)
        part->teleport(schedule, at, pose);
    publish(schedule, at);
}

void LaneModel::set_off(Schedule& schedule, const StepInput& at, const Buffer& before,
                        const Buffer& was, const Buffer& next, float jump) {
    for (const PartPtr& part : parts_)
        if (part->settings().substeps == at.substeps)
            part->set_off(schedule, at, before, was, next, jump);
}

void LaneModel::carry(Schedule& schedule, const StepInput& at, const plait_pose& motion) {
    for (const PartPtr& part : parts_)
        part->carry(schedule, motion);
    publish(schedule, at);
}

SagReport LaneModel::sag() const {
    SagReport all;
    for (const PartPtr& part : parts_)
        all.add(part->sag());
    return all;
}

void LaneModel::read_settings(std::span<Settings> settings) const {
    for (const PartPtr& part : parts_)
        for (const uint32_t strand : part->members())
            settings[strand] = part->settings();
}

void LaneModel::add_dynamic(std::pmr::vector<LaneBuffer>& to) const {
    for (const PartPtr& part : parts_)
        part->add_dynamic(to);
}

void LaneModel::add_pressure(std::pmr::vector<LaneBuffer>& to) const {
    for (const PartPtr& part : parts_)
        to.push_back(part->pressure());
}

void LaneModel::add_normal_force(std::pmr::vector<LaneBuffer>& to) const {
    for (const PartPtr& part : parts_)
        to.push_back(part->normal_force());
}

Status LaneModel::clear_normal_force(Device& device) {
    for (const PartPtr& part : parts_)
        PLAIT_TRY(part->clear_normal_force(device));
    return {};
}

Status LaneModel::begin_history(Device& device, const Params& then) {
    for (const PartPtr& part : parts_)
        PLAIT_TRY(part->begin_history(device, then));
    return {};
}

uint64_t LaneModel::device_bytes() const {
    uint64_t bytes = 0;
    for (const PartPtr& part : parts_)
        bytes += part->device_bytes();
    return bytes;
}

} // namespace

std::unique_ptr<Model> make_lane_model(const Settings& settings, const ModelInput& input) {
    return std::make_unique<LaneModel>(settings, input);
}

} // namespace plait
