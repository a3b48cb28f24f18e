// SPDX-License-Identifier: Apache-2.0
// Files that are cut off, lie about their sizes, or try to reach outside.
#include "support.h"

#include <cstdint>

namespace gnomon::scene::test {
namespace {

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

std::string glb(const std::string& json_text, const std::string& binary)
{
    const auto word = [](std::size_t value) {
        std::string out;
        for (int i = 0; i < 4; ++i) {
            out += static_cast<char>(value >> (8 * i) & 0xFFU);
        }
        return out;
    };
    std::string padded = json_text;
    padded.resize((padded.size() + 3) / 4 * 4, ' ');
    std::string out = "glTF" + word(2) + word(12 + 8 + padded.size() + 8 + binary.size());
    out += word(padded.size()) + "JSON" + padded;
    return out + word(binary.size()) + std::string("BIN\0", 4) + binary;
}

TEST(GltfHostile, EveryTruncationOfAContainerIsRefused)
{
    FileBuilder file;
    file.addMesh({{"attributes", {{"POSITION", file.addTriangle()}}}});
    file.root["buffers"] = json::array({{{"byteLength", file.data.size()}}});
    const std::string whole =
        glb(file.text(), std::string(reinterpret_cast<const char*>(file.data.data()), file.data.size()));
    EXPECT_EQ(readText(whole).meshes.at(0).primitives.at(0).positions.size(), 3U);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        EXPECT_THROW(static_cast<void>(readText(whole.substr(0, size))), Error) << size;
    }
}

TEST(GltfHostile, EveryFlippedByteEndsInASceneOrAnError)
{
    FileBuilder file;
    file.addMesh({{"attributes", {{"POSITION", file.addTriangle()}}}});
    const std::string whole = file.text();
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (const unsigned mask : {0x01U, 0x10U, 0x80U}) {
            std::string bent = whole;
            bent[i] = static_cast<char>(static_cast<unsigned char>(bent[i]) ^ mask);
            try {
                static_cast<void>(evaluate(readText(bent), 0.0));
            } catch (const Error&) { // anything else fails the test
            }
        }
    }
}

/// A NUL ends the text for the parser, so what follows one would not be read.
TEST(GltfHostile, BehindANulThereMayBePaddingAlone)
{
    FileBuilder file;
    file.addMesh({{"attributes", {{"POSITION", file.addTriangle()}}}});
    const std::string nuls(3, '\0');
    EXPECT_EQ(readText(file.text() + nuls).meshes.size(), 1U);
    EXPECT_EQ(readText(glb(file.text() + nuls, "")).meshes.size(), 1U);
    const std::string message = errorOfText(file.text() + nuls + "{}");
    EXPECT_TRUE(contains(message, "a NUL byte")) << message;
    EXPECT_TRUE(contains(message, "(byte " + std::to_string(file.text().size() + 1) + ")")) << message;
    EXPECT_TRUE(contains(errorOfText(nuls), "invalid JSON"));
}

TEST(GltfHostile, HugeCountsAreRefusedBeforeAnythingIsAllocated)
{
    FileBuilder file;
    file.addMesh({{"attributes", {{"POSITION", file.addTriangle()}}}});
    file.root["accessors"][0]["count"] = 4294967295U;
    EXPECT_TRUE(contains(file.error(), "the accessor does not fit its buffer view of 36 bytes at /accessors/0"));
    file.root["accessors"][0].erase("bufferView"); // now nothing but the limit holds it
    EXPECT_TRUE(contains(file.error(), "--limit vertices=N"));
}

TEST(GltfHostile, SharedMeshesCountOncePerNode)
{
    FileBuilder file;
    const int position = file.addTriangle();
    const json primitive = {{"attributes", {{"POSITION", position}}}};
    file.root["meshes"] = json::array({{{"primitives", json::array({primitive, primitive, primitive, primitive})}}});
    file.root["nodes"] = json::array({{{"mesh", 0}}, {{"mesh", 0}}, {{"mesh", 0}}});
    EXPECT_EQ(evaluate(file.read(), 0.0).objects.size(), 12U);
    EXPECT_TRUE(
        contains(file.error({.max_count = 11}), "the number of objects is over the limit count=11 at /nodes/2"));
}

TEST(GltfHostile, OffsetsCannotWrapAround)
{
    for (const double offset : {9007199254740988.0, 4294967296.0, 1.8446744073709552e19, -4.0}) {
        FileBuilder file;
        static_cast<void>(file.addTriangle());
        file.root["accessors"][0]["byteOffset"] = offset;
        EXPECT_TRUE(contains(file.error(), "/accessors/0/byteOffset")) << offset;
        FileBuilder view;
        static_cast<void>(view.addTriangle());
        view.root["bufferViews"][0]["byteOffset"] = offset;
        EXPECT_TRUE(contains(view.error(), "/bufferViews/0")) << offset;
    }
}

TEST(GltfHostile, DeepNestingIsRefused)
{
    const std::string deep(100000, '[');
    EXPECT_TRUE(contains(errorOfText(deep), "nested deeper than 128"));
    EXPECT_TRUE(contains(errorOfText(R"({"asset":{"version":"2.0"},"extras":)" + deep), "nested deeper"));
    std::string objects;
    for (int i = 0; i < 100000; ++i) {
        objects += R"({"a":)";
    }
    EXPECT_TRUE(contains(errorOfText(objects), "nested deeper"));
}

TEST(GltfHostile, JsonThatIsNot)
{
    EXPECT_TRUE(contains(errorOfText("\xEF\xBB\xBF{}"), "byte order mark"));
    EXPECT_TRUE(contains(errorOfText("{\"asset\":\"\xFF\xFE\"}"), "invalid JSON"));
    EXPECT_TRUE(contains(errorOfText(R"({"asset":{"version":"2.0","version":"1.0"}})"), "same key twice at /asset"));
    EXPECT_TRUE(contains(errorOfText(R"({"asset":{"version":"2.0"},"x":[0,1e999]})"), "at /x/1"));
    EXPECT_TRUE(contains(errorOfText(R"({"asset":)"), "invalid JSON"));
    EXPECT_TRUE(contains(errorOfText(""), "invalid JSON"));
    EXPECT_TRUE(contains(errorOfText(R"({"asset":{"version":"2.0"}} x)"), "invalid JSON"));
}

TEST(GltfHostile, DataUris)
{
    const auto scene = [](const std::string& uri, int length) {
        return json{{"asset", {{"version", "2.0"}}}, {"buffers", json::array({{{"byteLength", length}, {"uri", uri}}})}}
            .dump();
    };
    EXPECT_NO_THROW(static_cast<void>(readText(scene("data:,%20ab", 3))));
    EXPECT_NO_THROW(static_cast<void>(readText(scene("data:application/gltf-buffer;base64,AAECAw==", 4))));
    EXPECT_NO_THROW(static_cast<void>(readText(scene("data:;base64,AAECAw", 4)))); // padding may be missing
    EXPECT_TRUE(contains(errorOfText(scene("data:;base64,AAECAw==", 5)), "shorter than byteLength 5"));
    EXPECT_TRUE(contains(errorOfText(scene("data:;base64,A!ECAw==", 4)), "invalid base64 at /buffers/0/uri"));
    EXPECT_TRUE(contains(errorOfText(scene("data:;base64,AAECA", 3)), "invalid base64"));
    EXPECT_TRUE(contains(errorOfText(scene("data:,%2", 1)), "invalid percent encoding"));
    EXPECT_TRUE(contains(errorOfText(scene("data:", 1)), "comma"));
}

TEST(GltfHostile, PathsStayInsideTheFolder)
{
    const TemporaryFolder folder;
    folder.write("secret.bin", "0123");
    folder.write("asset/data/in side.bin", "0123");
    std::filesystem::create_symlink("../secret.bin", folder.path() / "asset/link.bin");
    std::filesystem::create_symlink("data", folder.path() / "asset/inner");
    const auto attempt = [&](const std::string& uri) {
        const json file = {{"asset", {{"version", "2.0"}}},
                           {"buffers", json::array({{{"byteLength", 4}, {"uri", uri}}})}};
        folder.write("asset/scene.gltf", file.dump());
        return folder.path() / "asset/scene.gltf";
    };
    EXPECT_NO_THROW(static_cast<void>(readGltf(attempt("data/in%20side.bin"))));
    EXPECT_NO_THROW(static_cast<void>(readGltf(attempt("./inner/in side.bin")))); // a link that stays inside
    const std::string absolute = (folder.path() / "secret.bin").string();
    for (const std::string& uri : {std::string("../secret.bin"), std::string("data/../../secret.bin"), absolute,
                                   std::string("%2e%2e/secret.bin"), std::string("link.bin"), "file://" + absolute,
                                   std::string("http://example.com/a.bin"), std::string("a%00b"), std::string("data"),
                                   std::string("missing.bin"), std::string("%zz"), std::string()}) {
        const std::string message = errorOfFile(attempt(uri));
        EXPECT_TRUE(contains(message, "at /buffers/0/uri")) << message;
        EXPECT_FALSE(contains(message, "0123"));
    }
}

TEST(GltfHostile, FilesThatAreNone)
{
    const TemporaryFolder folder;
    folder.write("empty.glb", "");
    EXPECT_TRUE(contains(errorOfFile(folder.path()), "it is a directory"));
    EXPECT_TRUE(contains(errorOfFile(folder.path() / "none.gltf"), "cannot be opened"));
    EXPECT_TRUE(contains(errorOfFile(folder.path() / "empty.glb"), "the file is empty"));
    EXPECT_TRUE(contains(errorOfFile("/dev/zero"), "a plain file is needed"));
}

TEST(GltfHostile, EveryLimitIsNamedWithItsFlag)
{
    FileBuilder file;
    file.addMesh({{"attributes", {{"POSITION", file.addTriangle()}}}});
    const auto expect = [&](const Limits& limits, const std::string& name, std::uint64_t value) {
        const std::string message = file.error(limits);
        EXPECT_TRUE(contains(message, "over the limit " + name + "=" + std::to_string(value))) << message;
        EXPECT_TRUE(contains(message, "--limit " + name + "=N")) << message;
    };
    expect({.max_file_bytes = 20}, "file-bytes", 20);
    expect({.max_total_bytes = 600}, "total-bytes", 600);
    expect({.max_vertices = 3}, "vertices", 3);
    file.root["nodes"] = json::array({{{"children", {1}}}, {{"children", {2}}}, json::object()});
    expect({.max_node_depth = 2}, "node-depth", 2);
    expect({.max_count = 2}, "count", 2);
    EXPECT_NO_THROW(static_cast<void>(file.read({.max_node_depth = 3, .max_count = 3})));
    file.root["images"] = json::array(
        {{{"uri", "data:image/"
                  "png;base64,"
                  "iVBORw0KGgoAAAANSUhEUgAAAAMAAAABCAIAAACUgoPjAAAADElEQVQI12NgAAIAAAUAAeImBZsAAAAASUVORK5CYII="}}});
    expect({.max_image_side = 2}, "image-side", 2);
}

} // namespace
} // namespace gnomon::scene::test
