// SPDX-License-Identifier: Apache-2.0
#include "blur_choice.h"

#include "host/renderer.h"

#include "commands.h"

#include <gnomon/vulkan/blur_trial.h>

namespace gnomon::host {

BlurPath chooseBlurPath(Gpu& gpu, const vulkan::FilterOptions& filter)
{
    const MomentOptions& moments = filter.moments;
    const FilterTraits* traits = filterTraits(filter.filter);
    const bool blurs = traits != nullptr && traits->filterable && blurRadius(moments) > 0;
    if (moments.blur_path != BlurPath::automatic || !blurs ||
        refusal(filter.filter, filter.format, moments).has_value()) {
        return moments.blur_path;
    }
    BlurChoices::Entry wanted{filter.format, blurRadius(moments), imageLayersPerMap(filter.filter, moments),
                              moments.log_space, BlurPath::compute};
    for (const BlurChoices::Entry& entry : gpu.blurChoices().entries) {
        if (entry.format == wanted.format && entry.radius_texels == wanted.radius_texels &&
            entry.image_layers == wanted.image_layers && entry.log_space == wanted.log_space) {
            return entry.path;
        }
    }
    vulkan::BlurTrial trial(gpu.view(), filter, gpu.pipelineCache());
    Commands commands(gpu, DebugNames(), "blur trial");
    trial.record(commands.begin());
    commands.finish();
    wanted.path = trial.faster();
    gpu.blurChoices().entries.push_back(wanted);
    return wanted.path;
}

} // namespace gnomon::host
