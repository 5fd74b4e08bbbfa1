// Which instruction sets this processor has: the functions of Highway's targets.h that its dispatch calls, by
// the same rules. Highway has them in a shared library, which also times the processor's clock, for
// benchmarks, each time that a program starts: a third of what the command took to start, and under valgrind
// it has no end.
#include "hwy/targets.h"

#include <array>
#include <atomic>
#include <cstdint>

#if HWY_ARCH_X86
#include <cpuid.h>
#endif

namespace hwy {
namespace {

std::atomic<std::int64_t> allowed{-1}, pretended{0};

#if HWY_ARCH_X86

/// A bit of what cpuid says; registers count from eax.
bool cpuid_bit(unsigned leaf, std::size_t position, int bit) {
    std::array<unsigned, 4> registers{};
    auto& [eax, ebx, ecx, edx] = registers;
    return __get_cpuid_count(leaf, 0, &eax, &ebx, &ecx, &edx) != 0 && (registers[position] >> bit & 1U) != 0;
}

bool has_sse4() {
    return __builtin_cpu_supports("sse4.1") && __builtin_cpu_supports("sse4.2") &&
           __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul");
}

bool has_avx2() {
    const bool lzcnt = cpuid_bit(0x80000001, 2, 5), f16c = cpuid_bit(1, 2, 29);
    return __builtin_cpu_supports("avx") && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") && lzcnt && f16c;
}

bool has_avx512() {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw");
}

/// What came with Ice Lake and Zen 4.
bool has_later_avx512() {
    const bool vaes = cpuid_bit(7, 2, 9);
    return __builtin_cpu_supports("avx512vnni") && __builtin_cpu_supports("avx512vbmi") &&
           __builtin_cpu_supports("avx512vbmi2") && __builtin_cpu_supports("avx512bitalg") &&
           __builtin_cpu_supports("avx512vpopcntdq") && __builtin_cpu_supports("vpclmulqdq") &&
           __builtin_cpu_supports("gfni") && vaes;
}

std::int64_t targets_of_processor() {
    __builtin_cpu_init();
    std::int64_t targets = HWY_ENABLED_BASELINE;
    if (!__builtin_cpu_supports("ssse3")) return targets;
    targets |= HWY_SSSE3;
    if (!has_sse4()) return targets;
    targets |= HWY_SSE4;
    if (!has_avx2()) return targets;
    targets |= HWY_AVX2;
    if (!has_avx512()) return targets;
    return targets | HWY_AVX3 | (has_later_avx512() ? HWY_AVX3_DL : 0);
}

#else

/// Elsewhere nothing but the baseline is compiled.
std::int64_t targets_of_processor() {
    return HWY_ENABLED_BASELINE;
}

#endif

}  // namespace

std::int64_t SupportedTargets() {
    const std::int64_t supported = pretended != 0 ? pretended.load() : targets_of_processor();
    const std::int64_t targets = supported & allowed;
    return targets != 0 ? targets : HWY_STATIC_TARGET;
}

void DisableTargets(std::int64_t disabled_targets) {
    allowed = ~disabled_targets;
    GetChosenTarget().DeInit();
}

void SetSupportedTargetsForTest(std::int64_t targets) {
    pretended = targets;
    GetChosenTarget().DeInit();
}

ChosenTarget& GetChosenTarget() {
    static ChosenTarget chosen;
    return chosen;
}

}  // namespace hwy
