// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <vector>

/// Bit for bit, so that NaN equals itself and -0 differs from 0.
template <typename T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}
