// SPDX-License-Identifier: Apache-2.0
// Makes small glTF files in memory and reads them.
#pragma once

#include "scene/gltf.h"
#include "scene/state.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace gnomon::scene::test {

using nlohmann::json;

[[nodiscard]] std::string base64(const std::vector<std::byte>& bytes);
[[nodiscard]] std::vector<std::byte> toBytes(std::string_view text);

/// A glTF file with one buffer; every accessor gets a buffer view of its own.
struct FileBuilder {
    json root = {{"asset", {{"version", "2.0"}}}};
    std::vector<std::byte> data;

    template <typename T>
    int addView(const std::vector<T>& values)
    {
        while (data.size() % 4 != 0) {
            data.push_back(std::byte{0});
        }
        const std::size_t offset = data.size();
        data.resize(offset + values.size() * sizeof(T));
        std::memcpy(data.data() + offset, values.data(), values.size() * sizeof(T));
        root["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
        return static_cast<int>(root["bufferViews"].size()) - 1;
    }

    int addAccessor(json accessor)
    {
        root["accessors"].push_back(std::move(accessor));
        return static_cast<int>(root["accessors"].size()) - 1;
    }

    template <typename T>
    int add(const char* type, int component_type, std::size_t count, const std::vector<T>& values,
            bool normalized = false)
    {
        json accessor = {
            {"bufferView", addView(values)}, {"type", type}, {"componentType", component_type}, {"count", count}};
        if (normalized) {
            accessor["normalized"] = true;
        }
        return addAccessor(accessor);
    }

    /// One mesh of one primitive on one node.
    void addMesh(json primitive)
    {
        root["meshes"].push_back({{"primitives", json::array({std::move(primitive)})}});
        root["nodes"].push_back({{"mesh", root["meshes"].size() - 1}});
    }

    /// A right triangle in the xy plane, as float positions.
    int addTriangle() { return add<float>("VEC3", 5126, 3, {0, 0, 0, 1, 0, 0, 0, 1, 0}); }

    [[nodiscard]] std::string text() const;
    [[nodiscard]] Scene read(const Limits& limits = {}) const;
    /// The message of the Error that reading throws; fails the test when it does not throw.
    [[nodiscard]] std::string error(const Limits& limits = {}) const;
};

[[nodiscard]] Scene readText(std::string_view text, const Limits& limits = {});
[[nodiscard]] std::string errorOfText(std::string_view text, const Limits& limits = {});
[[nodiscard]] std::string errorOfFile(const std::filesystem::path& file, const Limits& limits = {});

/// Where corpora and scenes are; empty when they are not on this machine.
[[nodiscard]] std::filesystem::path sharedFolder(const char* name);

/// A folder that is removed with its contents.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    void write(const std::filesystem::path& name, std::string_view content) const;

private:
    std::filesystem::path path_;
};

} // namespace gnomon::scene::test
