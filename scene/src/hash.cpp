// SPDX-License-Identifier: Apache-2.0
// XXH3 with 128 bits, as libxxhash has it: Y. Collet, xxHash, 2019. Values are hashed as they lie in memory, so results
// of a little-endian and of a big-endian machine differ; nothing is meant to be carried from one to the other.
#include "scene/hash.h"

#include <new>
#include <xxhash.h>

namespace gnomon::scene {
namespace {

XXH3_state_t* stateOf(void* state)
{
    return static_cast<XXH3_state_t*>(state);
}

} // namespace

std::string toString(const Hash128& hash)
{
    constexpr std::string_view kDigits = "0123456789abcdef";
    constexpr unsigned kBitsPerDigit = 4;
    std::string text;
    for (const std::uint64_t half : {hash.high, hash.low}) {
        for (unsigned shift = 64; shift > 0; shift -= kBitsPerDigit) {
            text += kDigits[(half >> (shift - kBitsPerDigit)) & 15U];
        }
    }
    return text;
}

Hasher::Hasher() : state_(XXH3_createState())
{
    if (state_ == nullptr) {
        throw std::bad_alloc();
    }
    XXH3_128bits_reset(stateOf(state_));
}

Hasher::~Hasher()
{
    XXH3_freeState(stateOf(state_));
}

void Hasher::addBytes(std::span<const std::byte> bytes)
{
    if (!bytes.empty()) {
        XXH3_128bits_update(stateOf(state_), bytes.data(), bytes.size());
    }
}

void Hasher::addText(std::string_view text)
{
    add(static_cast<std::uint64_t>(text.size()));
    addBytes(std::as_bytes(std::span(text)));
}

Hash128 Hasher::value() const
{
    const XXH128_hash_t hash = XXH3_128bits_digest(stateOf(state_));
    return {hash.high64, hash.low64};
}

} // namespace gnomon::scene
