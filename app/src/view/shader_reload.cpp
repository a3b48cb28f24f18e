// SPDX-License-Identifier: Apache-2.0
#include "view/shader_reload.h"

#include "files/files.h"

#include <gnomon/error.h>

#include <algorithm>
#include <cstring>
#include <sstream>
#include <system_error>
#include <utility>

namespace gnomon::app::view {

namespace fs = std::filesystem;

namespace {

constexpr double kLook_s = 0.4;
constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 24;

/// The value of "NAME:TYPE=VALUE" in a cache of CMake; empty where there is none.
std::string cached(std::string_view cache, std::string_view name)
{
    const std::string start = "\n" + std::string(name) + ":";
    const std::size_t at = cache.find(start);
    const std::size_t equals = at == std::string_view::npos ? at : cache.find('=', at);
    if (equals == std::string_view::npos) {
        return "";
    }
    return std::string(cache.substr(equals + 1, cache.find('\n', equals) - equals - 1));
}

/// Calls `visit(path, time)` for each plain file in a folder and below. What goes away meanwhile is passed over.
template <class Visit>
void forEachFile(const fs::path& folder, const Visit& visit)
{
    std::error_code fault;
    for (auto at = fs::recursive_directory_iterator(folder, fault); !fault && at != fs::recursive_directory_iterator();
         at.increment(fault)) {
        std::error_code gone;
        const fs::file_time_type time = at->last_write_time(gone);
        if (!gone && at->is_regular_file(gone) && !gone) {
            visit(at->path(), time);
        }
    }
}

std::vector<std::uint32_t> readModule(const fs::path& file)
{
    const std::string bytes = readWholeFile(file, kLargestFile, "shader module");
    constexpr std::uint32_t kMagic = 0x07230203;
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
    if (words.empty() || words[0] != kMagic || bytes.size() % sizeof(std::uint32_t) != 0) {
        throw Error("reading shader module " + file.string(), "it is no SPIR-V of this machine");
    }
    return words;
}

} // namespace

std::optional<ShaderBuild> findShaderBuild()
{
    std::error_code fault;
    const fs::path program = fs::read_symlink("/proc/self/exe", fault);
    const fs::path folder = program.parent_path();
    if (fault || !fs::is_regular_file(folder / "CMakeCache.txt", fault)) {
        return std::nullopt;
    }
    std::string cache;
    try {
        cache = "\n" + readWholeFile(folder / "CMakeCache.txt", kLargestFile);
    } catch (const Error&) {
        return std::nullopt;
    }
    const fs::path home = cached(cache, "CMAKE_HOME_DIRECTORY");
    const std::string cmake = cached(cache, "CMAKE_COMMAND");
    ShaderBuild build;
    build.sources = {home / "shaders", home / "host" / "shaders"};
    build.modules = {folder / "shaders" / "gnomon_spirv", folder / "shaders" / "gnomon_classic_spirv",
                     folder / "host" / "gnomon_host_spirv"};
    const auto is_there = [&fault](const fs::path& one) {
        return fs::is_directory(one, fault);
    };
    if (cmake.empty() || !std::all_of(build.sources.begin(), build.sources.end(), is_there) ||
        !std::all_of(build.modules.begin(), build.modules.end(), is_there)) {
        return std::nullopt;
    }
    build.command = {cmake,
                     "--build",
                     folder.string(),
                     "--target",
                     "gnomon_spirv_modules",
                     "gnomon_classic_spirv_modules",
                     "gnomon_host_spirv_modules"};
    build.made = fs::last_write_time(program, fault);
    return fault ? std::nullopt : std::optional(build);
}

std::string compilerFaults(std::string_view output, const ShaderBuild& build)
{
    std::vector<std::string> all;
    std::vector<std::string> faults;
    std::istringstream lines{std::string(output)};
    for (std::string line; std::getline(lines, line);) {
        for (const fs::path& source : build.sources) {
            const std::string above = source.parent_path().string() + "/";
            for (std::size_t at = 0; (at = line.find(above, at)) != std::string::npos;) {
                line.erase(at, above.size());
            }
        }
        const bool is_fault =
            line.find(": error:") != std::string::npos || line.find(": warning:") != std::string::npos;
        // A source says the same in each of its variants.
        if (is_fault && std::find(faults.begin(), faults.end(), line) == faults.end()) {
            faults.push_back(line);
        }
        all.push_back(std::move(line));
    }
    constexpr std::ptrdiff_t kLast = 12;
    if (faults.empty()) {
        faults.assign(all.end() - std::min(kLast, std::ssize(all)), all.end());
    }
    std::string text;
    for (const std::string& line : faults) {
        text += line + "\n";
    }
    return text;
}

ShaderReload::ShaderReload(ShaderBuild build) : build_(std::move(build)), times_(timesOfSources())
{
    try {
        modules_ = newModules();
    } catch (const Error& error) { // half written: the next compilation makes it anew
        faults_ = error.what();
    }
    before_ = modules_;
}

vulkan::ShaderHook ShaderReload::hook()
{
    const auto words = [](void* user, const char* name) {
        const Modules& modules = static_cast<ShaderReload*>(user)->modules_;
        const auto found = modules.find(std::string_view(name));
        return found != modules.end() ? std::span<const std::uint32_t>(found->second)
                                      : std::span<const std::uint32_t>();
    };
    return {this, words};
}

ShaderReload::Times ShaderReload::timesOfSources() const
{
    Times times;
    for (const fs::path& folder : build_.sources) {
        forEachFile(folder, [&times](const fs::path& file, fs::file_time_type time) { times[file] = time; });
    }
    return times;
}

ShaderReload::Modules ShaderReload::newModules() const
{
    Modules modules;
    for (const fs::path& folder : build_.modules) {
        forEachFile(folder, [this, &modules](const fs::path& file, fs::file_time_type time) {
            if (time > build_.made && file.extension() == ".spv") {
                modules[file.stem().string()] = readModule(file);
            }
        });
    }
    return modules;
}

ShaderNews ShaderReload::end(int status)
{
    const std::string said = compiler_->text();
    compiler_.reset();
    faults_.clear();
    if (status != 0) {
        faults_ = compilerFaults(said, build_);
        return ShaderNews::failed;
    }
    try {
        Modules modules = newModules();
        if (modules == modules_) {
            return ShaderNews::unchanged;
        }
        before_ = std::exchange(modules_, std::move(modules));
    } catch (const Error& error) {
        faults_ = error.what();
        return ShaderNews::failed;
    }
    return ShaderNews::compiled;
}

ShaderNews ShaderReload::turn(double now_s)
{
    if (compiler_) {
        const std::optional<int> status = compiler_->look();
        return status ? end(*status) : ShaderNews::none;
    }
    if (now_s - looked_s_ < kLook_s) {
        return ShaderNews::none;
    }
    looked_s_ = now_s;
    Times times = timesOfSources();
    if (times == times_) {
        return ShaderNews::none;
    }
    times_ = std::move(times);
    try {
        compiler_.emplace(build_.command);
    } catch (const Error& error) {
        faults_ = error.what();
        return ShaderNews::failed;
    }
    return ShaderNews::compiling;
}

} // namespace gnomon::app::view
