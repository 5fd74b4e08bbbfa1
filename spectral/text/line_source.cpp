#include "spectral/text/line_source.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {

LineSource::LineSource(std::string text) : buffer_{std::move(text)} {}

std::shared_ptr<LineSource> LineSource::of_file(const std::string& path) {
    auto source = std::make_shared<LineSource>(std::string{});
    if (path == "-") {
        // closed or a folder, which would pass for an empty file
        if (::read(STDIN_FILENO, nullptr, 0) != 0)
            throw Error{std::string{"<stdin>: cannot be read: "} + std::strerror(errno)};
        source->descriptor_ = STDIN_FILENO;
        return source;
    }
    require_file(path);
    source->descriptor_ = ::open(path_to_read(path).c_str(), O_RDONLY | O_CLOEXEC);
    if (source->descriptor_ < 0) throw Error{path + ": cannot be read: " + std::strerror(errno)};
    return source;
}

LineSource::~LineSource() {
    if (descriptor_ > STDIN_FILENO) ::close(descriptor_);
}

bool LineSource::is_empty_file() {
    return descriptor_ > STDIN_FILENO && at_end() && !failed_;
}

bool LineSource::at_end() {
    return place_ == buffer_.size() && !refill();
}

bool LineSource::take_line(std::string& line) {
    constexpr std::size_t longest = std::size_t{1} << 26;
    line.clear();
    while (!at_end()) {
        const std::string_view rest = std::string_view{buffer_}.substr(place_);
        const auto end = rest.find('\n');
        const std::string_view part = rest.substr(0, end);
        if (const auto nul = part.find('\0'); nul != std::string_view::npos) {
            line += part.substr(0, nul + 1);
            place_ += nul + 1;
            return true;
        }
        line += part;
        place_ += part.size();
        if (end != std::string_view::npos) {
            ++place_;
            return true;
        }
        if (line.size() > longest) throw Error{"line of more than 64 MiB: must be text in lines"};
    }
    return !line.empty();
}

bool LineSource::take_bytes(std::size_t count, std::string& bytes) {
    bytes.clear();
    while (bytes.size() < count && !at_end()) {
        const std::string_view part = std::string_view{buffer_}.substr(place_, count - bytes.size());
        bytes += part;
        place_ += part.size();
    }
    return bytes.size() == count;
}

bool LineSource::refill() {
    constexpr std::size_t most = std::size_t{1} << 18;
    if (descriptor_ < 0 || failed_) return false;
    buffer_.resize(most);
    place_ = 0;
    ssize_t count = -1;
    do {
        count = ::read(descriptor_, buffer_.data(), buffer_.size());
    } while (count < 0 && errno == EINTR);
    failed_ = count < 0;
    buffer_.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    return count > 0;
}

}  // namespace hts::spectral
