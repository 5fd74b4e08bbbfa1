#include "damaged_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <new>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/sampling/random.hpp"

namespace {

constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
thread_local std::size_t memory_left = unlimited;
thread_local bool memory_exceeded = false;

}  // namespace

#ifndef __has_feature
#define __has_feature(feature) 0
#endif
// The thread sanitizer has these operators itself; with it a budget limits nothing.
#if !__has_feature(thread_sanitizer)
// Those of arrays call these.
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
    memory_exceeded = memory_exceeded || size > memory_left;
    if (size > memory_left) return nullptr;
    if (memory_left != unlimited) memory_left -= size;
    return std::malloc(std::max<std::size_t>(size, 1));
}
void* operator new(std::size_t size) {
    if (void* const memory = operator new(size, std::nothrow)) return memory;
    throw std::bad_alloc{};
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
    std::free(memory);
}
#endif

namespace hts::tables::testing {

MemoryBudget::MemoryBudget(std::size_t bytes) {
    memory_exceeded = false;
    memory_left = bytes;
}

MemoryBudget::~MemoryBudget() {
    memory_left = unlimited;
}

bool MemoryBudget::exceeded() const noexcept {
    return memory_exceeded;
}

std::string damaged(const DamagedFile& file, Random& random) {
    const auto below = [&](std::size_t end) { return static_cast<std::size_t>(random.bits() % end); };
    std::string bytes = file.good;
    for (std::size_t changes = 1 + below(3); changes > 0 && !bytes.empty(); --changes) {
        const std::size_t end = below(4) != 0 ? std::min(file.head, bytes.size()) : bytes.size();
        const std::size_t at = below(end), length = std::min(1 + below(40), bytes.size() - at);
        switch (below(16)) {
            case 0:
                bytes.resize(at);
                break;
            case 1:
            case 2:
                bytes.erase(at, length);
                break;
            case 3:
            case 4:
                bytes.insert(at, std::string{bytes, at, length});
                break;
            case 5:
            case 6:
            case 7:
                bytes[at] = static_cast<char>(random.bits());
                break;
            case 8:
            case 9:
            case 10:
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
                break;
            default: {
                const std::string& nasty = file.nasty[below(file.nasty.size())];
                const std::size_t over = below(2) != 0 ? nasty.size() : 1 + below(8);
                bytes.replace(at, std::min(over, bytes.size() - at), nasty);
            }
        }
    }
    return file.mended ? file.mended(std::move(bytes), random) : bytes;
}

namespace {

enum class Outcome { sound, refused, failed };

/// What came of it; `message` what was thrown.
Outcome outcome(const DamagedFile& file, const std::string& bytes, std::size_t most, std::string& message) {
    const MemoryBudget budget{most};
    Outcome outcome = Outcome::sound;
    try {
        file.read(bytes);
    } catch (const Error& error) {
        outcome = Outcome::refused;
        message = error.what();
    } catch (const std::exception& other) {
        outcome = Outcome::failed;
        message = std::string{other.what()}.append(" is no hts::Error");
    }
    if (!budget.exceeded()) return outcome;
    message = "takes more than " + std::to_string(most) + " bytes";
    return Outcome::failed;
}

}  // namespace

void require_sound(bool sound) {
    if (!sound) throw std::logic_error{"unsound"};
}

namespace {

/// Where a file that failed is kept.
std::string kept(const DamagedFile& file, std::size_t seed, const std::string& bytes) {
    const auto path = std::filesystem::temp_directory_path() / std::string{"damaged "}
                                                                   .append(file.name)
                                                                   .append(" " + std::to_string(seed))
                                                                   .append(" " + std::to_string(::getpid()));
    std::ofstream{path, std::ios::binary} << bytes;
    return path.string();
}

}  // namespace

void check_damaged(const DamagedFile& file) {
    const std::size_t cases = hts::testing::exhaustive() ? file.exhaustive : file.quick;
    const std::size_t most = (std::size_t{4} << 20) + 64 * file.good.size();
    std::size_t refused = 0;
    std::string message;
    CHECK(outcome(file, file.good, most, message) == Outcome::sound);
    for (std::size_t seed = 0; seed < cases; ++seed) {
        Random random{seed};
        const std::string bytes = damaged(file, random);
        const Outcome came = outcome(file, bytes, most, message);
        if (came == Outcome::failed) FAIL(kept(file, seed, bytes) << ": " << message);
        if (came != Outcome::refused) continue;
        ++refused;
        if (message.size() < 8)
            FAIL(file.name << ", seed " << seed << ": \"" << message << "\" says nothing");
    }
    std::cout << file.name << ": " << refused << " of " << cases << " damaged files refused\n";
    CHECK(refused > 0);
    CHECK(refused < cases);
}

}  // namespace hts::tables::testing
