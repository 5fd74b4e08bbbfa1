#include "spectral/text/text.hpp"

#include <unistd.h>
#include <utf8.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>

#include "spectral/text/run_files.hpp"

namespace hts::spectral {
namespace {

constexpr std::string_view white_space = " \t\r\n\f\v";
constexpr const char* standard_input = "/dev/stdin";

// A device may have no end: what is no text, or too long for one, is refused while it is read.
std::string contents(const std::filesystem::path& path) {
    constexpr std::size_t part = std::size_t{1} << 20, most = std::size_t{1} << 31;
    errno = 0;
    std::ifstream file{path_to_read(path), std::ios::binary};
    std::string text;
    while (file.good()) {
        const std::size_t before = text.size();
        text.resize(before + part);
        file.read(text.data() + before, part);
        text.resize(before + static_cast<std::size_t>(file.gcount()));
        if (text.find('\0', before) != std::string::npos) break;
        if (text.size() > most) throw Error{path.string() + ": more than 2 GiB: must be less for a text"};
    }
    if (!file.is_open() || file.bad()) {
        throw Error{path.string() + ": cannot be read: " + std::strerror(errno)};
    }
    return text;
}

char lower(char c) noexcept {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// NUL is UTF-8, but no text.
void require_utf8(const std::string& text, const std::filesystem::path& path) {
    const auto bad = utf8::find_invalid(text.begin(), std::find(text.begin(), text.end(), '\0'));
    if (bad == text.end()) return;
    const auto line = 1 + std::count(text.begin(), bad, '\n');
    throw Error{path.string() + ":" + std::to_string(line) + ": " + no_text(text)};
}

}  // namespace

void require_file(const std::filesystem::path& path) {
    // closed, it would pass for an empty file
    if (path == standard_input && ::read(STDIN_FILENO, nullptr, 0) != 0)
        throw Error{std::string{"<stdin>: cannot be read: "} + std::strerror(errno)};
    std::error_code failure;
    const auto status = std::filesystem::status(path_to_read(path), failure);
    if (status.type() == std::filesystem::file_type::not_found) throw Error{path.string() + ": no such file"};
    if (failure) throw Error{path.string() + ": cannot be read: " + failure.message()};
    if (std::filesystem::is_directory(status)) throw Error{path.string() + ": is a directory, not a file"};
}

std::string no_text(std::string_view bytes) {
    const bool utf16 = bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff");
    return utf16 ? "UTF-16: must be UTF-8 text" : "not UTF-8 text";
}

bool is_text(std::string_view bytes) noexcept {
    unsigned char all = 0;
    bool any_nul = false;
    for (const char c : bytes) {
        all = static_cast<unsigned char>(all | static_cast<unsigned char>(c));
        any_nul |= c == '\0';
    }
    if (any_nul) return false;
    if (all < 0x80) return true;
    return utf8::is_valid(bytes.data(), bytes.data() + bytes.size());
}

std::string read_text_file(const std::filesystem::path& path) {
    require_file(path);
    return checked_text(contents(path), path);
}

std::string checked_text(std::string bytes, const std::filesystem::path& path) {
    if (bytes.starts_with(byte_order_mark)) bytes.erase(0, byte_order_mark.size());
    if (trimmed(bytes).empty()) throw Error{path.string() + ": file is empty"};
    require_utf8(bytes, path);
    return bytes;
}

std::string_view trimmed(std::string_view text) noexcept {
    if (!text.empty() && text.front() > ' ' && text.back() > ' ') return text;
    const auto first = text.find_first_not_of(white_space);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(white_space) - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> pieces;
    for (auto end = text.find(separator); end != std::string_view::npos; end = text.find(separator)) {
        pieces.push_back(text.substr(0, end));
        text.remove_prefix(end + 1);
    }
    pieces.push_back(text);
    return pieces;
}

std::vector<std::string_view> words(std::string_view text) {
    std::vector<std::string_view> pieces;
    for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
        const auto end = std::min(text.find_first_of(white_space), text.size());
        pieces.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return pieces;
}

std::string joined(const std::vector<std::string>& names) {
    std::string list;
    for (const auto& name : names) list.append(list.empty() ? "" : ", ").append(name);
    return list;
}

bool same_letters(std::string_view a, std::string_view b) noexcept {
    return std::ranges::equal(a, b, {}, lower, lower);
}

std::string in_quotes(std::string_view text) {
    std::string line = '"' + std::string{text} + '"';
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < ' '; }, '?');
    return line;
}

std::string brief(double value, int digits) {
    std::array<char, 32> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr;
    return {text.data(), end};
}

std::string brief(const std::vector<double>& values, int digits) {
    std::vector<std::string> texts;
    texts.reserve(values.size());
    for (const double value : values) texts.push_back(brief(value, digits));
    return joined(texts);
}

double number_in(std::string_view text) {
    std::string_view digits = trimmed(text);
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    double value = 0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (failure == std::errc::invalid_argument || end != digits.data() + digits.size()) {
        throw Error{in_quotes(text) + " is not a number"};
    }
    if (failure == std::errc::result_out_of_range) {
        throw Error{in_quotes(text) + " is too large or too small for a number"};
    }
    if (!std::isfinite(value)) throw Error{in_quotes(text) + " is not a finite number"};
    return value;
}

double number_in(std::string_view text, std::string_view quantity) {
    try {
        return number_in(text);
    } catch (const Error& error) {
        throw Error{std::string{quantity} + ": " + error.what()};
    }
}

}  // namespace hts::spectral
