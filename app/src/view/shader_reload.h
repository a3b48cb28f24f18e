// SPDX-License-Identifier: Apache-2.0
// Shaders that are worked on while the window is open: their sources are followed, compiled when one is saved, and put
// in the place of those that the program was built with.
#pragma once

#include "view/child.h"

#include <gnomon/vulkan/device_view.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app::view {

/// Where shaders come from.
struct ShaderBuild {
    std::vector<std::filesystem::path> sources; // folders, looked through to their ends
    std::vector<std::string> command;           // compiles what has changed
    std::vector<std::filesystem::path> modules; // folders of NAME.spv
    std::filesystem::file_time_type made;       // modules that are newer are other than the program's
};

/// That of the running program. Nothing unless it lies in the folder where CMake has built it, beside its sources.
[[nodiscard]] std::optional<ShaderBuild> findShaderBuild();

/// What of a compiler's output people have to read: each line that names a fault once, paths from a source folder's
/// parent on; the last lines where none does.
[[nodiscard]] std::string compilerFaults(std::string_view output, const ShaderBuild& build);

enum class ShaderNews : std::uint8_t { none, compiling, unchanged, compiled, failed };

class ShaderReload {
public:
    explicit ShaderReload(ShaderBuild build);

    /// For GpuOptions::shaders; holds as long as this does, which stays where it is.
    [[nodiscard]] vulkan::ShaderHook hook();
    /// Looks at the sources, a few times a second, and at the compiler. `now_s`: of any clock. `compiled`: whoever has
    /// pipelines makes them anew. Not while others make some.
    [[nodiscard]] ShaderNews turn(double now_s);
    /// Why the last one failed; empty where it did not.
    [[nodiscard]] const std::string& faults() const { return faults_; }
    /// How many modules are other than the program's.
    [[nodiscard]] std::size_t count() const { return modules_.size(); }
    /// To those before the last `compiled`, which cannot be drawn with.
    void goBack() { modules_ = before_; }

private:
    using Times = std::map<std::filesystem::path, std::filesystem::file_time_type>;
    using Modules = std::map<std::string, std::vector<std::uint32_t>, std::less<>>;

    [[nodiscard]] Times timesOfSources() const;
    [[nodiscard]] Modules newModules() const;
    [[nodiscard]] ShaderNews end(int status);

    ShaderBuild build_;
    Times times_;
    Modules modules_;
    Modules before_;
    std::optional<Child> compiler_;
    std::string faults_;
    double looked_s_ = 0.0;
};

} // namespace gnomon::app::view
