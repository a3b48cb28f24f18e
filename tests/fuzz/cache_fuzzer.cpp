// SPDX-License-Identifier: Apache-2.0
// Whatever an entry's bytes are, they are a truth of the size that was asked for, or none. The checksum is made right
// first, since it keeps all else that is wrong from being looked at; half the time it is left as it is.
#include "cache_entry.h"

#include <cstdlib>
#include <cstring>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace gnomon;
    constexpr std::uint32_t kMaxSide = 16;
    truth::EntryHeader said;
    if (size < sizeof(said)) {
        return truth::parseHeader({reinterpret_cast<const char*>(data), size}, size, {}).has_value() ? 1 : 0;
    }
    std::string bytes(reinterpret_cast<const char*>(data), size);
    std::memcpy(&said, bytes.data(), sizeof(said));
    if (said.width > kMaxSide || said.height > kMaxSide) {
        return 0;
    }
    const std::string_view payload = std::string_view(bytes).substr(sizeof(said));
    if (bytes.back() % 2 == 0) {
        said.payload_bytes = payload.size();
        scene::Hasher hasher;
        hasher.addBytes(std::as_bytes(std::span(&said, 1)).first(offsetof(truth::EntryHeader, checksum)));
        hasher.addBytes(std::as_bytes(std::span(payload)));
        said.checksum = hasher.value();
        std::memcpy(bytes.data(), &said, sizeof(said));
    }
    const truth::Kind kind = said.kind == 0 ? truth::Kind::hard : truth::Kind::area;
    const auto header = truth::parseHeader(bytes, bytes.size(), {said.key, {said.width, said.height}, kind});
    const auto traced = header ? truth::decodePayload(*header, payload) : std::nullopt;
    // An accepted entry can be written again.
    if (traced && !truth::encodeEntry(said.key, *traced)) {
        std::abort();
    }
    return 0;
}
