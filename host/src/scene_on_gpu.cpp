// SPDX-License-Identifier: Apache-2.0
#include "scene_data.h"

#include "closed_meshes.h"
#include "occlusion.h"

#include <algorithm>
#include <functional>

namespace gnomon::host {

SceneData::SceneData(Gpu& the_gpu, const scene::Scene& the_scene, const scene::State& state)
    : SceneData(the_gpu, the_scene, state,
                std::async(std::launch::async | std::launch::deferred, closures, std::cref(the_scene)))
{
}

SceneData::SceneData(Gpu& the_gpu, const scene::Scene& the_scene, const scene::State& state,
                     std::future<std::vector<scene::MeshClosure>> closed)
    : gpu(the_gpu), scene(the_scene), memory(the_gpu), uploader(std::make_unique<Uploader>(the_gpu, memory)),
      textures(the_gpu, memory, *uploader, the_scene), materials(the_gpu, memory, *uploader, textures, the_scene),
      geometry(memory, *uploader, the_scene, state), table(geometry, materials, the_scene, state, closed.get()),
      pipelines(the_gpu, memory.names(), materials, table)
{
    uploader->submit(); // the GPU has time while the first renderer makes its pipelines
}

double SceneData::occlusionRadius_m()
{
    if (!occlusion_radius_m) {
        occlusion_radius_m = occlusionRadius(scene, scene::evaluate(scene, 0.0));
    }
    return *occlusion_radius_m;
}

SceneOnGpu::SceneOnGpu(Gpu& gpu, const scene::Scene& scene, const scene::State& state)
    : data_(std::make_unique<SceneData>(gpu, scene, state))
{
}

SceneOnGpu::~SceneOnGpu() = default;

Gpu& SceneOnGpu::gpu() const
{
    return data_->gpu;
}

const scene::Scene& SceneOnGpu::scene() const
{
    return data_->scene;
}

std::vector<vulkan::MemoryUse> SceneOnGpu::memory() const
{
    std::vector<vulkan::MemoryUse> uses = data_->memory.uses();
    std::erase_if(uses, [](const vulkan::MemoryUse& use) { return use.bytes == 0; });
    return uses;
}

} // namespace gnomon::host
