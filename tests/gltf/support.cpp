// SPDX-License-Identifier: Apache-2.0
#include "support.h"

#include <cstdlib>
#include <fstream>

#include <unistd.h>

namespace gnomon::scene::test {

std::string base64(const std::vector<std::byte>& bytes)
{
    static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group = group << 8 | (i + k < bytes.size() ? std::to_integer<unsigned>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            out += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
        }
    }
    return out;
}

std::vector<std::byte> toBytes(std::string_view text)
{
    const auto* data = reinterpret_cast<const std::byte*>(text.data());
    return {data, data + text.size()};
}

std::string FileBuilder::text() const
{
    json out = root;
    if (!data.empty() && !out.contains("buffers")) {
        out["buffers"] = json::array(
            {{{"byteLength", data.size()}, {"uri", "data:application/octet-stream;base64," + base64(data)}}});
    }
    return out.dump();
}

Scene FileBuilder::read(const Limits& limits) const
{
    return readText(text(), limits);
}
std::string FileBuilder::error(const Limits& limits) const
{
    return errorOfText(text(), limits);
}

Scene readText(std::string_view text, const Limits& limits)
{
    return readGltf(toBytes(text), {}, limits);
}

namespace {

template <typename Read>
std::string messageOf(const Read& read)
{
    try {
        static_cast<void>(read());
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "the file was not refused";
    return {};
}

} // namespace

std::string errorOfText(std::string_view text, const Limits& limits)
{
    return messageOf([&] { return readText(text, limits); });
}

std::string errorOfFile(const std::filesystem::path& file, const Limits& limits)
{
    return messageOf([&] { return readGltf(file, limits); });
}

std::filesystem::path sharedFolder(const char* name)
{
    const char* set = std::getenv("GNOMON_SHARED");
    const std::filesystem::path folder = std::filesystem::path(set != nullptr ? set : GNOMON_SHARED_DIR) / name;
    return std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}

TemporaryFolder::TemporaryFolder()
{
    std::string pattern = (std::filesystem::temp_directory_path() / "gnomon_gltf_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
        throw std::runtime_error("no temporary folder");
    }
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

void TemporaryFolder::write(const std::filesystem::path& name, std::string_view content) const
{
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << content;
}

} // namespace gnomon::scene::test
