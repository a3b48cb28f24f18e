// SPDX-License-Identifier: Apache-2.0
#include "executor.h"

#include "map_storage.h"
#include "state.h"

#include <gnomon/plan_views.h>

#include <algorithm>
#include <variant>

namespace gnomon::gl {
namespace {

constexpr std::size_t kImages = static_cast<std::size_t>(pack::ImageName::camera_ids) + 1;
constexpr std::size_t kBuffers = static_cast<std::size_t>(pack::BufferName::points) + 1;

constexpr GLuint kUnits = 12; // texture units that modules have

GLenum formatOf(const std::optional<MapFormat>& format)
{
    return format ? mapStorage(*format).mapFormat() : GL_R32UI;
}

VertexArray makeVertexArray(const Context& context)
{
    GLuint name = 0;
    context.gl.CreateVertexArrays(1, &name);
    return {context, name};
}

/// The host's texture of this name; 0: it is one of this backend's.
GLuint hostTexture(const MaskInputs* inputs, pack::ImageName name)
{
    if (inputs == nullptr) {
        return 0;
    }
    switch (name) {
    case pack::ImageName::camera_depth:
        return inputs->depth;
    case pack::ImageName::camera_normal:
        return inputs->normal;
    case pack::ImageName::camera_smooth:
        return inputs->smooth;
    case pack::ImageName::camera_ids:
        return inputs->object_id;
    default:
        return 0;
    }
}

bool same(const Tile& a, const Tile& b)
{
    return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

bool same(const pack::CommandTarget& a, const pack::CommandTarget& b)
{
    return a.colour == b.colour && a.colour_layer == b.colour_layer && a.depth == b.depth &&
           a.depth_layer == b.depth_layer && same(a.viewport, b.viewport) && same(a.scissor, b.scissor) &&
           a.channels == b.channels;
}

template <class Slot> Slot& at(std::vector<Slot>& slots, std::size_t index)
{
    if (index >= slots.size()) {
        slots.resize(index + 1);
    }
    return slots[index];
}

} // namespace

Executor::Executor(const Context& context)
    : context_(context), programs_(context), framebuffer_(makeFramebuffer(context)),
      nearest_(makeSampler(context, false)), linear_(makeSampler(context, true)),
      no_vertices_(makeVertexArray(context))
{
}

Executor::ImageSlot& Executor::slot(const pack::ImageRef& image)
{
    return at(images_, image.options * kImages + static_cast<std::size_t>(image.name));
}

Executor::BufferSlot& Executor::slot(const pack::BufferRef& buffer)
{
    return at(buffers_, buffer.options * kBuffers + static_cast<std::size_t>(buffer.name));
}

TextureRef Executor::image(const pack::ImageRef& image) const
{
    const std::size_t index = image.options * kImages + static_cast<std::size_t>(image.name);
    return index < images_.size() && images_[index].image ? images_[index].image.ref() : TextureRef{};
}

std::span<const std::uint32_t> Executor::words(const pack::CommandRange& range) const
{
    return std::span(list_->words).subspan(range.first, range.count);
}

void Executor::run(const pack::CommandList& list, const Host& host)
{
    list_ = &list;
    host_ = &host;
    target_.reset();
    bound_ = {};
    context_.gl.BindVertexArray(no_vertices_.name());
    context_.gl.BlendEquationSeparatei(0, GL_MIN, GL_MIN);
    for (const pack::Command& command : list.commands) {
        std::visit([this](const auto& one) { carryOut(one); }, command);
    }
    setSwitch(context_, GL_DEPTH_TEST, false);
    context_.gl.Disablei(GL_BLEND, 0);
    unbindSamplers();
}

/// A sampler that stays bound would override a host's parameters of textures.
void Executor::unbindSamplers()
{
    for (GLuint unit = 0; unit < kUnits; ++unit) {
        context_.gl.BindSampler(unit, 0);
    }
}

void Executor::forget()
{
    images_.clear();
    buffers_.clear();
}

void Executor::carryOut(const pack::DropOptions& command)
{
    for (auto name = pack::ImageName::maps; name < pack::ImageName::mask;
         name = static_cast<pack::ImageName>(static_cast<int>(name) + 1)) {
        slot(pack::ImageRef{name, command.options}) = {};
    }
    for (auto name = pack::BufferName::layers; name < pack::BufferName::constants;
         name = static_cast<pack::BufferName>(static_cast<int>(name) + 1)) {
        slot(pack::BufferRef{name, command.options}) = {};
    }
}

void Executor::carryOut(const pack::MakeImage& command)
{
    const pack::ImageShape& shape = command.shape;
    ImageSlot made;
    made.image = Image(context_, {formatOf(shape.format), shape.size_px, shape.layers, shape.levels, shape.samples});
    ImageSlot& old = slot(command.image);
    if (command.keeps && old.image) {
        copyLevels(context_, old.image, made.image);
    }
    old = std::move(made);
    target_.reset();
}

void Executor::carryOut(const pack::MakeBuffer& command)
{
    BufferSlot made{makeBuffer(context_), command.bytes};
    context_.gl.NamedBufferData(made.buffer.name(), static_cast<GLsizeiptr>(command.bytes), nullptr, GL_DYNAMIC_COPY);
    BufferSlot& old = slot(command.buffer);
    if (command.copies > 0) {
        context_.gl.CopyNamedBufferSubData(old.buffer.name(), made.buffer.name(), 0, 0,
                                           static_cast<GLsizeiptr>(command.copies));
    }
    old = std::move(made);
    bound_ = {};
}

void Executor::carryOut(const pack::WriteBuffer& command)
{
    const BufferSlot& to = slot(command.buffer);
    const std::span<const std::uint32_t> data = words(command.data);
    if (command.alone) { // a driver need not wait for those who read what was there
        context_.gl.NamedBufferData(to.buffer.name(), static_cast<GLsizeiptr>(to.bytes), nullptr, GL_STREAM_DRAW);
    }
    context_.gl.NamedBufferSubData(to.buffer.name(), static_cast<GLintptr>(command.offset),
                                   static_cast<GLsizeiptr>(data.size_bytes()), data.data());
}

void Executor::carryOut(const pack::ZeroBuffer& command)
{
    context_.gl.ClearNamedBufferData(slot(command.buffer).buffer.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT,
                                     nullptr);
}

void Executor::carryOut(const pack::CopyTexels& command)
{
    copyTexels(context_, slot(command.from).image, command.area, slot(command.to).image, command.place);
}

void Executor::attach(GLenum attachment, const std::optional<pack::ImageRef>& image, std::uint32_t layer)
{
    const Image* const to = image ? &slot(*image).image : nullptr;
    if (to != nullptr && to->info().layers > 0) {
        context_.gl.NamedFramebufferTextureLayer(framebuffer_.name(), attachment, to->name(), 0,
                                                 static_cast<GLint>(layer));
    } else {
        context_.gl.NamedFramebufferTexture(framebuffer_.name(), attachment, to != nullptr ? to->name() : 0, 0);
    }
}

/// Binds the framebuffer with these attachments, and sets what goes with them.
void Executor::aim(const pack::CommandTarget& target)
{
    const Functions& gl = context_.gl;
    if (target_ && same(*target_, target)) {
        return;
    }
    attach(GL_COLOR_ATTACHMENT0, target.colour, target.colour_layer);
    attach(GL_DEPTH_ATTACHMENT, target.depth, target.depth_layer);
    gl.NamedFramebufferDrawBuffer(framebuffer_.name(), target.colour ? GL_COLOR_ATTACHMENT0 : GL_NONE);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
    setViewport(context_, target.viewport);
    setScissor(context_, target.scissor);
    const auto writes = [&](unsigned channel) {
        return static_cast<GLboolean>((target.channels >> channel & 1U) != 0 ? GL_TRUE : GL_FALSE);
    };
    gl.ColorMaski(0, writes(0), writes(1), writes(2), writes(3));
    target_ = target;
}

void Executor::carryOut(const pack::ClearTarget& command)
{
    aim(command.target);
    const std::array<float, 4> ones{1.0F, 1.0F, 1.0F, 1.0F};
    if (command.target.colour) {
        context_.gl.ClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, ones.data());
    }
    if (command.target.depth) {
        context_.gl.ClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, ones.data());
    }
}

void Executor::carryOut(const pack::DrawMapCasters& command)
{
    const View& view = host_->plan.views[command.view];
    MapPass pass;
    pass.formats = mapFormats(optionsOf(host_->plan, view), view.projection.orthographic);
    pass.plan = &host_->plan;
    pass.view = &view;
    pass.view_index = command.view;
    pass.casters = pack::castersOf(host_->plan, view, command.share);
    pass.clip_from_world = glm::mat4(view.projection.clip_from_world);
    pass.metric_ws = glm::vec4(view.projection.metric.metric_ws);
    aim(command.target);
    if (bound_.count > 0) {
        unbindSamplers();
    }
    setSwitch(context_, GL_DEPTH_TEST, true);
    setSwitch(context_, GL_DEPTH_CLAMP, view.projection.clamp_near);
    (*host_->draw)(pass);
    setSwitch(context_, GL_DEPTH_CLAMP, false);
    setSwitch(context_, GL_DEPTH_TEST, false);
    bound_ = {}; // the host binds textures
}

GLuint Executor::textureOf(const pack::CommandBinding& binding)
{
    if (const GLuint given = hostTexture(host_->inputs, binding.image.name); given != 0) {
        return given;
    }
    ImageSlot& have = slot(binding.image);
    if (binding.level == kNoIndex) {
        return have.image.name();
    }
    while (have.levels.size() <= binding.level) {
        have.levels.push_back(have.image.viewOfLevel(context_, static_cast<std::uint32_t>(have.levels.size())));
    }
    return have.levels[binding.level].name();
}

void Executor::bind(const pack::CommandBinding& binding)
{
    const Functions& gl = context_.gl;
    switch (binding.kind) {
    case pack::BindingKind::texture:
        gl.BindTextureUnit(binding.binding, textureOf(binding));
        gl.BindSampler(binding.binding, binding.linear ? linear_.name() : nearest_.name());
        break;
    case pack::BindingKind::storage_image: {
        const Image& image = slot(binding.image).image;
        gl.BindImageTexture(binding.binding, image.name(), static_cast<GLint>(binding.level), GL_TRUE, 0, GL_READ_WRITE,
                            image.info().format);
        break;
    }
    case pack::BindingKind::uniform: {
        const BufferSlot& have = slot(binding.buffer);
        gl.BindBufferRange(GL_UNIFORM_BUFFER, binding.binding, have.buffer.name(),
                           static_cast<GLintptr>(binding.offset),
                           static_cast<GLsizeiptr>(binding.bytes > 0 ? binding.bytes : have.bytes));
        break;
    }
    case pack::BindingKind::storage:
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding.binding, slot(binding.buffer).buffer.name());
        break;
    }
}

void Executor::use(GLuint program, const pack::CommandRange& push, const pack::CommandRange& bindings)
{
    context_.gl.UseProgram(program);
    programs_.push(words(push));
    if (bound_ != bindings) {
        for (const pack::CommandBinding& binding : std::span(list_->bindings).subspan(bindings.first, bindings.count)) {
            bind(binding);
        }
        bound_ = bindings;
    }
}

void Executor::carryOut(const pack::DrawTriangle& command)
{
    aim(command.target);
    use(programs_.draw(command.vertex, command.fragment, words(command.constants)), command.push, command.bindings);
    (command.least ? context_.gl.Enablei : context_.gl.Disablei)(GL_BLEND, 0);
    context_.gl.BindVertexArray(no_vertices_.name());
    context_.gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void Executor::carryOut(const pack::RunCompute& command)
{
    use(programs_.compute(command.module, words(command.constants)), command.push, command.bindings);
    context_.gl.DispatchCompute(command.groups[0], command.groups[1], command.groups[2]);
    waitForShaders(context_);
}

} // namespace gnomon::gl
