// SPDX-License-Identifier: Apache-2.0
#include "host/window/interface.h"

#include "abandoned.h"
#include "swap_chain.h"
#include "wait.h"

#include <gnomon/error.h>

#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_vulkan.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

namespace gnomon::host {
namespace {

/// Dear ImGui's own state, for as long as there is an Interface.
struct Context {
    Context()
    {
        IMGUI_CHECKVERSION();
        ImGui::SetCurrentContext(nullptr); // that of an interface whose device was abandoned is there still
        own = ImGui::CreateContext();
        ImGui::SetCurrentContext(own);
    }
    ~Context() { ImGui::DestroyContext(own); }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    ImGuiContext* own = nullptr;
};

/// Dear ImGui of this version knows which keys are down when a frame begins, and no more: what was pressed and let go
/// of within a slow one never was. So keys wait here, and a key that was pressed since the last frame is let go of in
/// the next one.
class KeyQueue {
public:
    explicit KeyQueue(GLFWwindow* window) : window_(window)
    {
        current = this;
        before_ = glfwSetKeyCallback(window, [](GLFWwindow*, int key, int code, int action, int mods) {
            current->keys_.push_back({key, code, action, mods});
        });
    }
    ~KeyQueue() { glfwSetKeyCallback(window_, before_); }
    KeyQueue(const KeyQueue&) = delete;
    KeyQueue& operator=(const KeyQueue&) = delete;

    /// Before a frame: tells what may be told now, of each key one thing.
    void tell()
    {
        std::vector<Key> later;
        std::vector<int> told;
        for (const Key& key : keys_) {
            if (std::find(told.begin(), told.end(), key.key) != told.end()) {
                later.push_back(key);
                continue;
            }
            told.push_back(key.key);
            before_(window_, key.key, key.code, key.action, key.mods);
        }
        keys_ = std::move(later);
    }

private:
    struct Key {
        int key = 0;
        int code = 0;
        int action = 0;
        int mods = 0;
    };

    static inline KeyQueue* current = nullptr;
    GLFWwindow* window_;
    GLFWkeyfun before_ = nullptr; // Dear ImGui's, which calls the window's
    std::vector<Key> keys_;
};

void checkResult(VkResult result)
{
    check(result, "drawing the interface");
}

/// Dark and quiet, so that the picture is what one sees; one warm colour, that of the sun.
void style(double scale)
{
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 0.0F;
    style.FrameRounding = 3.0F;
    style.GrabRounding = 3.0F;
    style.PopupRounding = 4.0F;
    style.ScrollbarRounding = 6.0F;
    style.WindowBorderSize = 0.0F;
    style.FramePadding = {6.0F, 3.0F};
    style.ItemSpacing = {6.0F, 5.0F};
    style.IndentSpacing = 14.0F;
    const ImVec4 sun{0.93F, 0.68F, 0.26F, 1.0F};
    const auto dim = [&sun](float share) {
        return ImVec4(sun.x * share, sun.y * share, sun.z * share, 1.0F);
    };
    ImVec4* const colours = style.Colors;
    colours[ImGuiCol_WindowBg] = {0.095F, 0.098F, 0.106F, 1.0F};
    colours[ImGuiCol_PopupBg] = {0.12F, 0.123F, 0.133F, 0.98F};
    colours[ImGuiCol_FrameBg] = {0.165F, 0.17F, 0.185F, 1.0F};
    colours[ImGuiCol_FrameBgHovered] = {0.22F, 0.225F, 0.245F, 1.0F};
    colours[ImGuiCol_FrameBgActive] = {0.26F, 0.265F, 0.285F, 1.0F};
    colours[ImGuiCol_Button] = {0.2F, 0.205F, 0.22F, 1.0F};
    colours[ImGuiCol_ButtonHovered] = {0.28F, 0.285F, 0.3F, 1.0F};
    colours[ImGuiCol_ButtonActive] = dim(0.6F);
    colours[ImGuiCol_Header] = {0.17F, 0.175F, 0.19F, 1.0F};
    colours[ImGuiCol_HeaderHovered] = {0.24F, 0.245F, 0.26F, 1.0F};
    colours[ImGuiCol_HeaderActive] = dim(0.5F);
    colours[ImGuiCol_CheckMark] = sun;
    colours[ImGuiCol_SliderGrab] = dim(0.8F);
    colours[ImGuiCol_SliderGrabActive] = sun;
    colours[ImGuiCol_PlotLines] = sun;
    colours[ImGuiCol_PlotHistogram] = dim(0.8F);
    colours[ImGuiCol_TextSelectedBg] = dim(0.45F);
    colours[ImGuiCol_NavHighlight] = sun;
    style.ScaleAllSizes(static_cast<float>(scale));
}

/// A clear font of the system where there is one, else Dear ImGui's own, of which every pixel shows.
void chooseFont(double scale)
{
    ImGuiIO& io = ImGui::GetIO();
    std::error_code ignored;
    if (std::filesystem::exists(GNOMON_FONT, ignored)) {
        constexpr double kHeight_px = 15.0;
        // Latin, Greek for formulas, and the arrows and signs of the panels.
        static constexpr std::array<ImWchar, 9> kLetters{0x20, 0xFF, 0x370, 0x3FF, 0x2010, 0x2193, 0x25A0, 0x25FF, 0};
        if (io.Fonts->AddFontFromFileTTF(GNOMON_FONT, static_cast<float>(kHeight_px * scale), nullptr,
                                         kLetters.data()) != nullptr) {
            return;
        }
    }
    ImFontConfig config;
    config.SizePixels = static_cast<float>(13.0 * scale);
    io.Fonts->AddFontDefault(&config);
}

Image8 imageOf(const void* texels, VkExtent2D extent, bool blue_first)
{
    Image8 image(extent.width, extent.height, 3);
    const auto* const from = static_cast<const std::uint8_t*>(texels);
    const std::size_t pixels = std::size_t{extent.width} * extent.height;
    for (std::size_t i = 0; i < pixels; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            image.values[i * 3 + c] = from[i * 4 + (blue_first ? 2 - c : c)];
        }
    }
    return image;
}

} // namespace

GpuOptions forWindow(GpuOptions options, const Window& window)
{
    options.surface_extensions = window.instanceExtensions();
    options.presents = Window::canShow;
    return options;
}

struct Interface::Impl {
    Impl(Window& the_window, Gpu& the_gpu)
        : window(the_window), gpu(the_gpu), memory(the_gpu), chain(the_window, the_gpu, memory.names()), texels(the_gpu)
    {
    }
    ~Impl();

    Window& window;
    Gpu& gpu;
    Memory memory;
    SwapChain chain;
    TexelCopies texels;
    Context context;
    OwnedDescriptorPool pool;
    bool has_glfw = false;
    bool has_vulkan = false;
    std::optional<KeyQueue> keys;

    void makePool();
    void makeBackends();
    void uploadFonts();
    bool end(std::span<const PicturePlace> pictures, bool reads);
};

Interface::Impl::~Impl()
{
    keys.reset(); // before the callbacks that it calls go
    settleQueue(gpu);
    if (has_vulkan && !gpu.abandoned()) {
        ImGui_ImplVulkan_Shutdown();
    }
    if (has_glfw) {
        ImGui_ImplGlfw_Shutdown();
    }
}

void Interface::Impl::makePool()
{
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1}; // the font
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    info.maxSets = 1;
    info.poolSizeCount = 1;
    info.pPoolSizes = &size;
    VkDescriptorPool made = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(gpu.view().device, &info, nullptr, &made), "making the interface");
    pool = {gpu, made};
}

void Interface::Impl::makeBackends()
{
    has_glfw = ImGui_ImplGlfw_InitForVulkan(window.handle(), true);
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = gpu.view().instance;
    info.PhysicalDevice = gpu.view().physical_device;
    info.Device = gpu.view().device;
    info.QueueFamily = gpu.queueFamily();
    info.Queue = gpu.queue();
    info.PipelineCache = gpu.pipelineCache();
    info.DescriptorPool = pool.get();
    info.MinImageCount = 2;
    info.ImageCount = std::max(chain.imageCount(), 2U);
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.CheckVkResultFn = checkResult;
    has_vulkan = ImGui_ImplVulkan_Init(&info, chain.pass());
    if (!has_glfw || !has_vulkan) {
        throw Error("making the interface", "Dear ImGui does not start");
    }
    keys.emplace(window.handle());
}

void Interface::Impl::uploadFonts()
{
    Commands commands(gpu, memory.names(), "fonts");
    (void)ImGui_ImplVulkan_CreateFontsTexture(commands.begin());
    commands.finish();
    ImGui_ImplVulkan_DestroyFontUploadObjects();
}

bool Interface::Impl::end(std::span<const PicturePlace> pictures, bool reads)
{
    ImGui::Render();
    const bool shown = chain.show(
        pictures, [](VkCommandBuffer commands) { ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands); },
        reads ? &texels : nullptr);
    if (reads) {
        chain.wait();
    }
    return shown;
}

Interface::Interface(Window& window, Gpu& gpu) : impl_(std::make_unique<Impl>(window, gpu))
{
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // it leaves no file wherever it is started
    io.LogFilename = nullptr;
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    (void)impl_->chain.prepare();
    style(window.contentScale());
    chooseFont(window.contentScale());
    impl_->makePool();
    impl_->makeBackends();
    impl_->uploadFonts();
}

Interface::~Interface()
{
    settleQueue(impl_->gpu);
    if (impl_->gpu.abandoned()) {
        keepForGood(std::move(impl_));
    }
}

bool Interface::begin()
{
    if (!impl_->chain.prepare()) {
        return false;
    }
    impl_->keys->tell();
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    return true;
}

bool Interface::end(std::span<const PicturePlace> pictures)
{
    return impl_->end(pictures, false);
}

Image8 Interface::endAndRead(std::span<const PicturePlace> pictures)
{
    if (!impl_->end(pictures, true)) {
        return {};
    }
    return imageOf(impl_->chain.texels(), impl_->chain.extent(), impl_->chain.isBlueFirst());
}

glm::uvec2 Interface::size_px() const
{
    return {impl_->chain.extent().width, impl_->chain.extent().height};
}

} // namespace gnomon::host
