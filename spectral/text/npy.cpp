#include "spectral/text/npy.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <regex>

#include "hts/error.hpp"
#include "spectral/text/line_source.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

static_assert(std::endian::native == std::endian::little);
constexpr std::string_view npy_magic = "\x93NUMPY";
constexpr std::size_t longest_npy_header = std::size_t{1} << 20;

template <class T>
double read_as(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

std::string npy_string(std::string_view text) {
    std::string quoted = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted + "'";
}

std::string matched(const std::string& header, const char* pattern) {
    std::smatch match;
    return std::regex_search(header, match, std::regex{pattern}) ? match[1].str() : std::string{};
}

}  // namespace

NpyReader::NpyReader(const std::string& path) : path_{path}, source_{LineSource::of_file(path)} {
    std::string start, length;
    const bool whole = source_->take_bytes(npy_magic.size() + 2, start) && start.starts_with(npy_magic) &&
                       source_->take_bytes(start[npy_magic.size()] == 1 ? 2 : 4, length);
    if (!whole) throw Error{path_ + ": not a .npy file of NumPy"};
    std::size_t size = 0;
    for (std::size_t i = 0; i < length.size(); ++i)
        size |= std::size_t{static_cast<unsigned char>(length[i])} << (8 * i);
    std::string header;
    if (size > longest_npy_header || !source_->take_bytes(size, header) || !is_text(header))
        throw Error{path_ + ": not a .npy file of NumPy: its header is damaged"};
    read_header(header);
}

void NpyReader::read_header(const std::string& header) {
    const std::string fields = matched(header, R"re('descr':\s*\[(.*?)\])re");
    const std::string rows = matched(header, R"re('shape':\s*\((\d{1,18}),?\))re");
    if (fields.empty() || rows.empty()) {
        throw Error{path_ +
                    ": must be a structured array of one dimension, whose fields are the columns, as "
                    "np.rec.fromarrays makes it"};
    }
    rows_ = std::stoull(rows);
    static const std::regex field{R"re(\(\s*'([^'\\]*)'\s*,\s*'([^']*)'\s*\))re"};
    for (std::sregex_iterator each{fields.begin(), fields.end(), field}; each != std::sregex_iterator{};
         ++each)
        add_field((*each)[1], (*each)[2]);
    static const std::regex others{R"re(^(\s*\(\s*'[^'\\]*'\s*,\s*'[^']*'\s*\)\s*,?)*\s*$)re"};
    if (!std::regex_match(fields, others))
        throw Error{path_ + ": fields " + in_quotes(fields) + ": must be numbers with plain names"};
}

void NpyReader::add_field(const std::string& name, const std::string& type) {
    static const std::array<std::string_view, 4> known{"<f8", "<f4", "<i8", "<i4"};
    if (std::find(known.begin(), known.end(), type) == known.end()) {
        throw Error{path_ + ": field " + in_quotes(name) + " is of type " + in_quotes(type) +
                    ": must be <f8, <f4, <i8 or <i4"};
    }
    columns_.push_back(name);
    fields_.push_back({type[1], row_size_, static_cast<std::size_t>(type[2] - '0')});
    row_size_ += fields_.back().size;
}

bool NpyReader::take(std::string& bytes) {
    if (taken_ == rows_) return false;
    if (!source_->take_bytes(row_size_, bytes)) {
        throw Error{path_ + ": ends after " + std::to_string(taken_) + " rows: must have " +
                    std::to_string(rows_) + " as its header says"};
    }
    ++taken_;
    return true;
}

void NpyReader::numbers(std::string_view bytes, std::vector<double>& values) const {
    values.resize(fields_.size());
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const auto& [kind, begin, size] = fields_[i];
        const char* const from = bytes.data() + begin;
        if (kind == 'f') {
            values[i] = size == 8 ? read_as<double>(from) : read_as<float>(from);
        } else {
            values[i] = size == 8 ? read_as<std::int64_t>(from) : read_as<std::int32_t>(from);
        }
    }
}

std::string npy_header(const std::vector<std::string>& columns, std::size_t rows) {
    constexpr std::size_t count_width = 20, alignment = 64, before = 12;
    std::string text = "{'descr': [";
    for (const std::string& column : columns)
        text.append(text.ends_with('[') ? "" : ", ").append("(" + npy_string(column) + ", '<f8')");
    const std::string count = std::to_string(rows);
    text += "], 'fortran_order': False, 'shape': (" + count + ",), }" +
            std::string(count_width - count.size(), ' ');
    text.resize((before + text.size() + 1 + alignment - 1) / alignment * alignment - before - 1, ' ');
    text += '\n';
    std::string header{npy_magic};
    header += '\3';  // UTF-8
    header += '\0';
    for (std::size_t i = 0; i < 4; ++i) header += static_cast<char>(text.size() >> (8 * i) & 0xFF);
    return header + text;
}

}  // namespace hts::spectral
