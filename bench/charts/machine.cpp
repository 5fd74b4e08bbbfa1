#include "bench/charts/machine.hpp"

#include <fstream>

#include "hts_bench_commit.hpp"

namespace hts::bench {
namespace {

/// The value of the first line "key : value" of /proc/cpuinfo, "" if there is none.
std::string processor_field(const std::string& key) {
    std::ifstream file{"/proc/cpuinfo"};
    for (std::string line; std::getline(file, line);) {
        const auto colon = line.find(':');
        if (colon == std::string::npos || !line.starts_with(key)) continue;
        if (line.find_first_not_of(" \t", key.size()) != colon) continue;
        const auto value = line.find_first_not_of(' ', colon + 1);
        return value == std::string::npos ? "" : line.substr(value);
    }
    return "";
}

std::string processor() {
    const std::string name = processor_field("model name");
    if (name.empty()) return "unknown processor";
    return name + " (family " + processor_field("cpu family") + ", model " + processor_field("model") + ")";
}

std::string compiler() {
#if defined(__clang__)
    return "clang++ " __clang_version__;
#elif defined(__GNUC__)
    return "g++ " __VERSION__;
#else
    return "unknown compiler";
#endif
}

}  // namespace

std::string Machine::text() const {
    return processor + ", " + compiler + " " + flags + ", commit " + commit;
}

Machine machine() {
    return {processor(), compiler(), HTS_BENCH_FLAGS, HTS_BENCH_COMMIT};
}

}  // namespace hts::bench
