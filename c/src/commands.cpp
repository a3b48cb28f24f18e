// SPDX-License-Identifier: Apache-2.0
// The commands of a frame, flat.
#include "handles.h"

#include <gnomon/pack/frame_commands.h>

#include <memory>
#include <string>
#include <variant>

using namespace gnomon;
using namespace gnomon::c;

struct GnomonRecorder {
    explicit GnomonRecorder(const pack::RecorderTraits& traits) : recorder(traits) {}

    pack::FrameRecorder recorder;
    pack::CommandList list;
    std::vector<GnomonCommand> commands;
    std::vector<GnomonBinding> bindings;
    GnomonCommandList flat{};
    Texts texts;
};

namespace {

template <class Name>
void setName(std::uint32_t (&out)[2], Name name, std::uint32_t options)
{
    out[0] = static_cast<std::uint32_t>(name);
    out[1] = options;
}

void setName(std::uint32_t (&out)[2], const std::optional<pack::ImageRef>& image)
{
    out[0] = GNOMON_NO_INDEX;
    if (image) {
        setName(out, image->name, image->options);
    }
}

void setRange(std::uint32_t (&out)[2], const pack::CommandRange& range)
{
    out[0] = range.first;
    out[1] = range.count;
}

void setTile(std::uint32_t (&out)[5], const Tile& tile)
{
    const std::uint32_t numbers[5] = {tile.layer, tile.x, tile.y, tile.width, tile.height};
    std::copy(std::begin(numbers), std::end(numbers), out);
}

void setPart(std::uint32_t (&out)[4], const Tile& tile)
{
    const std::uint32_t numbers[4] = {tile.x, tile.y, tile.width, tile.height};
    std::copy(std::begin(numbers), std::end(numbers), out);
}

void setTarget(GnomonCommand& out, const pack::CommandTarget& target)
{
    setName(out.colour, target.colour);
    out.colour_layer = target.colour_layer;
    setName(out.depth, target.depth);
    out.depth_layer = target.depth_layer;
    setPart(out.viewport, target.viewport);
    setPart(out.scissor, target.scissor);
    out.channels = target.channels;
}

/// Fills in what a command has beside its kind, which is its place in pack::Command.
class Flattener {
public:
    Flattener(GnomonRecorder& own, const Plan& plan) : own_(own), plan_(plan) {}

    void operator()(const pack::DropOptions& command) { out_->options = command.options; }
    void operator()(const pack::MakeImage& command)
    {
        setName(out_->image, command.image.name, command.image.options);
        const pack::ImageShape& shape = command.shape;
        out_->format = own_.texts(shape.format ? nameOf(*shape.format) : "r32ui");
        out_->size_px[0] = shape.size_px.x;
        out_->size_px[1] = shape.size_px.y;
        out_->layers = shape.layers;
        out_->levels = shape.levels;
        out_->samples = shape.samples;
        out_->keeps = command.keeps ? 1 : 0;
    }
    void operator()(const pack::MakeBuffer& command)
    {
        setName(out_->buffer, command.buffer.name, command.buffer.options);
        out_->bytes = command.bytes;
        out_->copies = command.copies;
    }
    void operator()(const pack::WriteBuffer& command)
    {
        setName(out_->buffer, command.buffer.name, command.buffer.options);
        out_->offset = command.offset;
        setRange(out_->data, command.data);
        out_->alone = command.alone ? 1 : 0;
    }
    void operator()(const pack::ZeroBuffer& command)
    {
        setName(out_->buffer, command.buffer.name, command.buffer.options);
    }
    void operator()(const pack::CopyTexels& command)
    {
        setName(out_->image, command.from.name, command.from.options);
        setTile(out_->area, command.area);
        setName(out_->to, command.to.name, command.to.options);
        setTile(out_->place, command.place);
    }
    void operator()(const pack::ClearTarget& command) { setTarget(*out_, command.target); }
    void operator()(const pack::DrawMapCasters& command)
    {
        setTarget(*out_, command.target);
        const std::span<const std::uint32_t> casters = pack::castersOf(plan_, plan_.views[command.view], command.share);
        out_->view = command.view;
        out_->share = static_cast<std::uint32_t>(command.share);
        out_->casters = casters.data();
        out_->caster_count = static_cast<std::uint32_t>(casters.size());
    }
    void operator()(const pack::DrawTriangle& command)
    {
        setTarget(*out_, command.target);
        out_->vertex = own_.texts(command.vertex);
        out_->least = command.least ? 1 : 0;
        setRun(command, command.fragment);
    }
    void operator()(const pack::RunCompute& command)
    {
        setRun(command, command.module);
        std::copy(command.groups.begin(), command.groups.end(), out_->groups);
    }

    void add(const pack::Command& command)
    {
        out_ = &own_.commands.emplace_back();
        out_->kind = static_cast<std::uint32_t>(command.index());
        std::visit(*this, command);
    }

private:
    template <class Run>
    void setRun(const Run& run, std::string_view module)
    {
        out_->module = own_.texts(module);
        setRange(out_->constants, run.constants);
        setRange(out_->push, run.push);
        setRange(out_->bindings, run.bindings);
    }

    GnomonRecorder& own_;
    const Plan& plan_;
    GnomonCommand* out_ = nullptr;
};
static_assert(std::variant_size_v<pack::Command> == GNOMON_RUN_COMPUTE + 1);

GnomonBinding flatBinding(const pack::CommandBinding& binding)
{
    GnomonBinding out{};
    out.binding = binding.binding;
    out.kind = static_cast<std::uint32_t>(binding.kind);
    setName(out.image, binding.image.name, binding.image.options);
    setName(out.buffer, binding.buffer.name, binding.buffer.options);
    out.level = binding.level;
    out.linear = binding.linear ? 1 : 0;
    out.offset = binding.offset;
    out.bytes = binding.bytes;
    return out;
}

void flatten(GnomonRecorder& own, const Plan& plan)
{
    Flattener flattener(own, plan);
    for (const pack::Command& command : own.list.commands) {
        flattener.add(command);
    }
    for (const pack::CommandBinding& binding : own.list.bindings) {
        own.bindings.push_back(flatBinding(binding));
    }
    GnomonCommandList& flat = own.flat;
    flat.commands = own.commands.data();
    flat.bindings = own.bindings.data();
    flat.words = own.list.words.data();
    flat.command_count = static_cast<std::uint32_t>(own.commands.size());
    flat.binding_count = static_cast<std::uint32_t>(own.bindings.size());
    flat.word_count = static_cast<std::uint32_t>(own.list.words.size());
}

/// Records by `record(recorder, plan)`, and flattens the list.
template <class Record>
const GnomonCommandList* recorded(const char* tried, GnomonRecorder* recorder, const GnomonPlanner* planner,
                                  const Record& record) noexcept
{
    return guardedPointer(tried, [&]() -> const GnomonCommandList* {
        GnomonRecorder& own = required(recorder, "recorder");
        const Plan& plan = *planned(planner).plan;
        own.list.clear();
        own.commands.clear();
        own.bindings.clear();
        own.flat = {};
        record(own, plan);
        try {
            flatten(own, plan);
        } catch (...) { // nobody will run what was recorded
            own.recorder.loseImages();
            throw;
        }
        return &own.flat;
    });
}

} // namespace

extern "C" {

GnomonRecorder* gnomonMakeRecorder(uint32_t header_interface, uint32_t most_layers, uint32_t uniform_alignment,
                                   uint32_t in_software) noexcept
{
    return guardedPointer("making a recorder", [&] {
        requireInterface(header_interface);
        if (most_layers == 0) {
            throw WrongCall{"most_layers is 0", "give the limit of the device"};
        }
        constexpr std::uint32_t kMostAlignment = 65536;
        if (uniform_alignment == 0 || uniform_alignment % 16 != 0 || uniform_alignment > kMostAlignment) {
            throw WrongCall{"uniform_alignment is " + std::to_string(uniform_alignment) +
                                ", no multiple of 16 up to 65536",
                            "give the limit of the device, or 16 where that is less"};
        }
        pack::RecorderTraits traits;
        traits.most_layers = most_layers;
        traits.uniform_alignment = uniform_alignment;
        traits.in_software = in_software != 0;
        return std::make_unique<GnomonRecorder>(traits).release();
    });
}

void gnomonFreeRecorder(GnomonRecorder* recorder) noexcept
{
    delete recorder;
}

const GnomonCommandList* gnomonRecordImages(GnomonRecorder* recorder, const GnomonPlanner* planner, uint32_t width_px,
                                            uint32_t height_px) noexcept
{
    return recorded("recording images", recorder, planner, [&](GnomonRecorder& own, const Plan& plan) {
        own.flat.changed = own.recorder.prepare(plan, {width_px, height_px}, own.list) ? 1 : 0;
    });
}

const GnomonCommandList* gnomonRecordMaps(GnomonRecorder* recorder, const GnomonPlanner* planner) noexcept
{
    return recorded("recording maps", recorder, planner, [&](GnomonRecorder& own, const Plan& plan) {
        own.recorder.drawMaps(plan, own.list);
        const pack::RecordedMaps maps = own.recorder.recorded();
        own.flat.maps_drawn = maps.drawn;
        own.flat.maps_kept_drawn = maps.kept_drawn;
        own.flat.maps_restored = maps.restored;
        own.flat.maps_held = maps.held;
    });
}

const GnomonCommandList* gnomonRecordMask(GnomonRecorder* recorder, const GnomonPlanner* planner, uint32_t images,
                                          const GnomonPrecision* precision) noexcept
{
    return recorded("recording the mask", recorder, planner, [&](GnomonRecorder& own, const Plan& plan) {
        constexpr std::uint32_t kAll = GNOMON_HAS_NORMALS | GNOMON_HAS_SMOOTH | GNOMON_HAS_IDS;
        if ((images & ~kAll) != 0) {
            throw WrongCall{"images is " + std::to_string(images) + ", which has bits that are none of GnomonHas",
                            "give the bits of the images that there are"};
        }
        pack::RecorderInputs inputs;
        inputs.normals = (images & GNOMON_HAS_NORMALS) != 0;
        inputs.smooth = (images & GNOMON_HAS_SMOOTH) != 0;
        inputs.ids = (images & GNOMON_HAS_IDS) != 0;
        if (precision != nullptr) {
            inputs.precision = taken(readStruct<GnomonPrecision, pack::DrawPrecision>(precision, "GnomonPrecision"));
        }
        own.recorder.drawMask(plan, inputs, own.list);
    });
}

GnomonStatus gnomonLoseRecorded(GnomonRecorder* recorder, uint32_t images_too) noexcept
{
    return guarded("losing maps", [&] {
        pack::FrameRecorder& own = required(recorder, "recorder").recorder;
        if (images_too != 0) {
            own.loseImages();
        } else {
            own.lose();
        }
    });
}

} // extern "C"
