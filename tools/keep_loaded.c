/* SPDX-License-Identifier: Apache-2.0
   Preloaded in sanitizer runs. The leak check comes after the Vulkan loader has unloaded the driver, and then nobody can say
   whose memory was left; so libraries stay, and tools/lsan.supp can name the driver's. */
int dlclose(void* handle)
{
    (void)handle;
    return 0;
}
