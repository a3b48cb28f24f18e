// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gnomon/vulkan/device_view.h>

namespace gnomon::test {
class NullDriver;
}
namespace gnomon::compiled {

/// Has the library make its pipelines: those of every choice, by the library's own code, which is given `view`. What it
/// records goes to the driver's command buffer.
void makeLibraryPipelines(const vulkan::DeviceView& view, test::NullDriver& driver);

} // namespace gnomon::compiled
