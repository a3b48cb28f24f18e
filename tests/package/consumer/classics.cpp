// SPDX-License-Identifier: Apache-2.0
// A host that wants classic techniques.
#include <gnomon/vulkan/classics.h>

int main()
{
    return gnomon::vulkan::makeClassics() == nullptr;
}
