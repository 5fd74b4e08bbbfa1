#include "hts/correlation/table_file.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <random>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "hts/correlation/kept_tables.hpp"

namespace hts::correlation_detail {
namespace {

namespace fs = std::filesystem;
using Word = std::uint64_t;
using Words = std::vector<Word>;

/// Another one for every change of what LobeTable computes.
constexpr Word edition = 2;
constexpr Word magic = 0x68747331'6c6f6265;  // of another byte order it is another number
constexpr auto ending = ".lobe", unfinished = ".part";

Word bits(double value) {
    return std::bit_cast<Word>(value);
}

/// FNV-1a, by words.
Word checksum(std::span<const Word> words) {
    Word sum = 0xcbf29ce484222325;
    for (const Word word : words) sum = (sum ^ word) * 0x100000001b3;
    return sum;
}

/// What a file of the shape begins with, as no file of another shape does.
Words head_of(const HeightShape& shape) {
    Words head{magic, edition, LobeTable::columns, LobeTable::row_length};
    for (const double layout : {LobeTable::least_g, LobeTable::greatest_g, LobeTable::crowded,
                                LobeTable::crowding, LobeTable::row_step, LobeTable::column_step})
        head.push_back(bits(layout));
    const std::vector<double> identity = shape.identity();
    head.push_back(identity.size());
    for (const double number : identity) head.push_back(bits(number));
    return head;
}

std::optional<LobeTable> read(const fs::path& path, const Words& head) {
    std::ifstream file{path, std::ios::binary};
    const std::size_t numbers = LobeTable::number_count();
    Words words(head.size() + numbers + 1);
    const auto size = static_cast<std::streamsize>(words.size() * sizeof(Word));
    if (!file.read(reinterpret_cast<char*>(words.data()), size)) return std::nullopt;
    if (file.peek() != std::ifstream::traits_type::eof()) return std::nullopt;
    if (!std::equal(head.begin(), head.end(), words.begin())) return std::nullopt;
    const Word stated = words.back();
    words.pop_back();
    if (checksum(words) != stated) return std::nullopt;
    std::vector<double> data(numbers);
    std::ranges::transform(std::span{words}.subspan(head.size()), data.begin(),
                           [](Word word) { return std::bit_cast<double>(word); });
    return LobeTable{data};
}

/// Removes what was not used for longest, and what another process left unfinished.
void tidy(const fs::path& folder) {
    std::error_code failed;
    std::vector<std::pair<fs::file_time_type, fs::path>> tables;
    const auto now = fs::file_time_type::clock::now();
    fs::directory_iterator entry{folder, failed};
    for (; !failed && entry != fs::directory_iterator{}; entry.increment(failed)) {
        std::error_code gone;  // by another process
        const auto age = entry->last_write_time(gone);
        if (gone) continue;
        if (entry->path().extension() == ending) tables.emplace_back(age, entry->path());
        if (entry->path().extension() == unfinished && now - age > std::chrono::hours{1})
            fs::remove(entry->path(), gone);
    }
    if (tables.size() <= most_kept_tables) return;
    std::ranges::sort(tables);
    for (const auto& [age, path] : std::span{tables}.first(tables.size() - most_kept_tables))
        fs::remove(path, failed);
}

void write(const fs::path& path, const Words& head, const LobeTable& table) {
    std::error_code failed;
    fs::create_directories(path.parent_path(), failed);
    Words words = head;
    for (const std::span<const double> part : table.numbers())
        std::ranges::transform(part, std::back_inserter(words), bits);
    words.push_back(checksum(words));
    const fs::path draft = path.string() + "-" + std::to_string(std::random_device{}()) + unfinished;
    {
        std::ofstream file{draft, std::ios::binary};
        const auto size = static_cast<std::streamsize>(words.size() * sizeof(Word));
        const bool whole = file.write(reinterpret_cast<const char*>(words.data()), size) && file.flush();
        if (!whole) {
            file.close();
            fs::remove(draft, failed);
            return;
        }
    }
    fs::rename(draft, path, failed);
    if (failed) fs::remove(draft, failed);
    tidy(path.parent_path());
}

}  // namespace

fs::path table_path(const fs::path& folder, const HeightShape& shape) {
    constexpr auto digits = "0123456789abcdef";
    std::string name;
    for (Word key = checksum(head_of(shape)); name.size() < 16; key >>= 4) name += digits[key & 15];
    return folder / (name + ending);
}

std::shared_ptr<const LobeTable> kept_table(const fs::path& folder, const ShapePointer& shape) {
    if (folder.empty()) return std::make_shared<const LobeTable>(shape);
    const fs::path path = table_path(folder, *shape);
    const Words head = head_of(*shape);
    if (auto found = read(path, head)) {
        std::error_code failed;
        fs::last_write_time(path, fs::file_time_type::clock::now(), failed);
        return std::make_shared<const LobeTable>(std::move(*found));
    }
    auto table = std::make_shared<const LobeTable>(shape);
    write(path, head, *table);
    return table;
}

}  // namespace hts::correlation_detail
