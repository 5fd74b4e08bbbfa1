#include <cstdint>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <hwy/targets.h>
#include <catch2/catch.hpp>

#if HWY_ARCH_X86

namespace {

/// What the kernel says that this processor has; empty where it does not say.
std::string flags() {
    std::ifstream file{"/proc/cpuinfo"};
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("flags")) return line + ' ';
    return {};
}

bool has_all(const std::string& flags, const std::vector<std::string>& names) {
    for (const std::string& name : names)
        if (flags.find(' ' + name + ' ') == std::string::npos) return false;
    return true;
}

}  // namespace

TEST_CASE("the vector kernels take the instruction sets that the kernel finds in the processor") {
    const std::string has = flags();
    if (has.empty()) return;
    std::vector<std::string> needed{"ssse3"};
    const auto check = [&](std::int64_t target, const std::vector<std::string>& more) {
        needed.insert(needed.end(), more.begin(), more.end());
        INFO(hwy::TargetName(target));
        CHECK(((hwy::SupportedTargets() & target) != 0) == has_all(has, needed));
        std::cout << hwy::TargetName(target) << (has_all(has, needed) ? " yes\n" : " no\n");
    };
    check(HWY_SSSE3, {});
    check(HWY_SSE4, {"sse4_1", "sse4_2", "aes", "pclmulqdq"});
    check(HWY_AVX2, {"avx", "avx2", "fma", "f16c", "abm", "bmi1", "bmi2"});
    check(HWY_AVX3, {"avx512f", "avx512cd", "avx512vl", "avx512dq", "avx512bw"});
    check(HWY_AVX3_DL, {"avx512_vnni", "avx512vbmi", "avx512_vbmi2", "avx512_bitalg", "avx512_vpopcntdq",
                        "vpclmulqdq", "gfni", "vaes"});
}

TEST_CASE("instruction sets can be forbidden and pretended") {
    const std::int64_t all = hwy::SupportedTargets();
    hwy::DisableTargets(HWY_SSSE3);
    CHECK(hwy::SupportedTargets() == (all & ~std::int64_t{HWY_SSSE3}));
    hwy::DisableTargets(0);
    hwy::SetSupportedTargetsForTest(HWY_SSSE3);
    CHECK(hwy::SupportedTargets() == HWY_SSSE3);
    hwy::SetSupportedTargetsForTest(0);
    CHECK(hwy::SupportedTargets() == all);
}

#endif
