// SPDX-License-Identifier: Apache-2.0
// Times of maps and mask by OpenGL and by Vulkan, frame by frame in turn: medians, and the one over the other. Usage:
// bench_gl [FRAMES] (21). Both wait for each frame. Exits with 77 where there is no context of OpenGL.
#include "option_steps.h"
#include "sides.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{640, 360};

struct Measured {
    const char* options;
    const char* lights; // lightsOf()
};
constexpr Measured kMeasured[] = {
    {"map-size=1024 partition=cascades filter=pcf", "sun"},
    {"map-size=512 partition=cube filter=hard", "lamp"},
    {"map-size=1024 partition=single filter=evsm", "sun spot"},
    {"map-size=1024 partition=cascades filter=raymarch", "sun"},
};

template <class Work>
double timed(Work&& work)
{
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void measure(const Measured& one, int frames, VulkanSide& vulkan, GlSide& by_gl)
{
    Planner planner(optionsFrom(one.options));
    const std::vector<Light> lights = lightsOf(one.lights);
    const Frame frame = vulkan.scene.frameOf(lights);
    by_gl.see(frame.camera);
    std::vector<double> gl_ms;
    std::vector<double> vulkan_ms;
    for (int i = -2; i < frames; ++i) { // programs are compiled in the first two
        planner.reset();                // all maps are drawn again
        const Plan& plan = planner.plan(frame);
        const double by_vulkan = timed([&] { vulkan.scene.run(vulkan.drawing, plan); });
        const double ours = timed([&] {
            by_gl.run(plan);
            glFinish();
        });
        if (i >= 0) {
            gl_ms.push_back(ours);
            vulkan_ms.push_back(by_vulkan);
        }
    }
    const double gl = median(gl_ms);
    const double reference = median(vulkan_ms);
    std::printf("%-52s %-9s %8.2f %8.2f %6.2f\n", one.options, one.lights, gl, reference, gl / reference);
}

int run(int frames)
{
    if (const std::string& missing = EglContext::instance().missing(); !missing.empty()) {
        std::fprintf(stderr, "bench_gl: %s\n", missing.c_str());
        return 77;
    }
    Gpu device(false);
    VulkanSide vulkan(kScreen, device);
    GlSide by_gl(kScreen);
    std::printf("%u x %u, %d frames, by %s\n%-52s %-9s %8s %8s %6s\n", kScreen.width, kScreen.height, frames,
                reinterpret_cast<const char*>(glGetString(GL_RENDERER)), "options", "lights", "GL ms", "Vulkan",
                "ratio");
    for (const Measured& one : kMeasured) {
        measure(one, frames, vulkan, by_gl);
    }
    return 0;
}

} // namespace
} // namespace gnomon::test

int main(int argc, char** argv)
{
    try {
        return gnomon::test::run(argc > 1 ? std::max(std::atoi(argv[1]), 1) : 21);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_gl: %s\n", error.what());
        return 1;
    }
}
