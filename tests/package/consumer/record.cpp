// SPDX-License-Identifier: Apache-2.0
// Takes something of each part that needs Vulkan's headers, and the project's own shaders.
#include <gnomon/options.h>
#include <gnomon/pack/technique_constants.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <consumer_spirv.h>

#include <cstdio>

int main()
{
    const gnomon::ResolvedOptions options = gnomon::resolvedOrThrow({});
    const gnomon::pack::TechniqueConstants constants = gnomon::pack::techniqueConstants(options);
    const bool has_features = gnomon::vulkan::requiredFeatures({}).pNext != nullptr;
    using namespace consumer::modules;
    const bool has_modules = mask_vert.size() > 5 && visible_hard_frag.size() > mask_vert.size() &&
                             all_of_consumer_spirv[1] == &visible_hard_frag && mask_vert.front() == 0x07230203;
    std::printf("features %d, modules %d, bytes of constants %zu\n", int(has_features), int(has_modules),
                sizeof(constants));
    return has_features && has_modules ? 0 : 1;
}
