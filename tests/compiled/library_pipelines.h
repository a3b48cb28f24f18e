// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gnomon/vulkan/device_view.h>

namespace gnomon::test {
class NullDriver;
}
namespace gnomon::compiled {

/// Lets the library make its pipelines for every choice, by its own code, which gets `view`. Its commands go to the
/// driver's command buffer.
void makeLibraryPipelines(const vulkan::DeviceView& view, test::NullDriver& driver);

} // namespace gnomon::compiled
