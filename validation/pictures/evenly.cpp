#include "validation/pictures/evenly.hpp"

namespace hts::validation {
namespace {

/// Mixes all bits (Murmur3's finaliser).
std::uint32_t hashed(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return x ^ (x >> 16);
}

std::uint32_t reversed(std::uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

/// Owen's scrambling of a binary fraction: every digit is turned or not as those above it say. On the
/// reversed number that is a hash in which bits move upwards only.
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
    x = reversed(x) + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reversed(x);
}

/// The second dimension of Sobol's sequence.
std::uint32_t sobol(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t direction = 0x80000000u; index != 0; index >>= 1, direction ^= direction >> 1) {
        if ((index & 1u) != 0) result ^= direction;
    }
    return result;
}

}  // namespace

std::uint32_t stream(std::uint32_t seed, std::uint32_t pixel, std::uint32_t dimensions) noexcept {
    return hashed(hashed(hashed(seed) ^ pixel) + 0x9e3779b9u * (dimensions + 1));
}

std::array<double, 2> even_point(std::uint32_t stream, std::uint32_t index) noexcept {
    const std::uint32_t shuffled = scrambled(index, stream);
    return {scrambled(reversed(shuffled), hashed(stream ^ 0x5bd1e995u)) * 0x1p-32,
            scrambled(sobol(shuffled), hashed(stream + 0x3c6ef372u)) * 0x1p-32};
}

}  // namespace hts::validation
