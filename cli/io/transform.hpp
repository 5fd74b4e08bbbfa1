/// A table turned into a longer or wider one, row by row on all cores.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "cli/io/summary.hpp"
#include "cli/io/table_writer.hpp"
#include "hts/error.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/parallel.hpp"
#include "spectral/text/csv.hpp"

namespace hts::cli {

using spectral::CsvLines;
using spectral::CsvReader;
using spectral::CsvRow;

/// Turns every input row into `each` output rows: the input's cells and what `append` adds. Works on a chunk
/// at a time, so memory does not grow with the table; the output is the same for any number of threads. An
/// unusual way of writing the input goes to standard error.
template <class Value>
class Transform {
  public:
    Transform(CsvReader& input, TableWriter& output, std::size_t each)
        : input_{input}, output_{output}, each_{each} {}

    ///   evaluate   (const CsvRow&, std::span<Value> of size each)   may throw hts::Error; path and line are
    ///              put in front
    ///   append     (TableWriter::Row&, const Value&)
    template <class Evaluate, class Append>
    Summary run(const Evaluate& evaluate, const Append& append) {
        if (const std::string dialect = input_.dialect_in_words(); !dialect.empty())
            std::cerr << "hts: " << input_.where_header() << dialect << '\n';
        watch_.start();
        const std::size_t rows = std::max<std::size_t>(1, values_per_chunk / each_);
        std::size_t count = 0;
        std::error_code unknown;  // of standard input and the like
        const auto size = std::filesystem::file_size(input_.name(), unknown);
        const spectral::Job job{"", unknown ? 0 : size};
        CsvLines chunk;
        for (input_.take(rows, chunk); !chunk.empty(); input_.take(rows, chunk)) {
            count += chunk.size();
            const std::size_t parts = answer(chunk, evaluate, append);
            for (std::size_t i = 0; i < parts; ++i) output_.add(texts_[i]);
            job.set_done(input_.bytes_read());
        }
        output_.finish();
        watch_.stop();
        return {count, each_, watch_.seconds()};
    }

  private:
    static constexpr std::size_t values_per_chunk = 1 << 14, values_at_once = 1 << 8;

    /// Renders what is written for some lines in as many texts as it says.
    template <class Evaluate, class Append>
    std::size_t answer(const CsvLines& lines, const Evaluate& evaluate, const Append& append) {
        // by one thread at once; few where they are few, since each may take long
        const std::size_t block =
            std::clamp<std::size_t>(values_at_once / each_, 1, std::max<std::size_t>(1, lines.size() / 64));
        const std::size_t parts = (lines.size() + block - 1) / block;
        texts_.resize(std::max(texts_.size(), parts));
        spectral::parallel_blocks(lines.size(), block, [&](std::size_t first, std::size_t number) {
            CsvRow row;
            std::vector<Value> values(each_);
            std::string& text = texts_[first / block];
            text.clear();
            for (std::size_t i = first; i < first + number; ++i) {
                input_.parse(lines, i, row);
                try {
                    evaluate(row, std::span{values});
                } catch (const Error& error) {
                    throw Error{input_.where(row.line) + error.what()};
                }
                write(text, row, values, append);
            }
        });
        return parts;
    }

    template <class Append>
    void write(std::string& text, const CsvRow& input, const std::vector<Value>& values,
               const Append& append) const {
        for (const Value& value : values) {
            TableWriter::Row row{output_, text};
            for (const std::string& field : input.fields) row.field(field);
            for (const double number : input.numbers) row.short_number(number);
            append(row, value);
            row.end();
        }
    }

    CsvReader& input_;
    TableWriter& output_;
    std::size_t each_;
    std::vector<std::string> texts_;  // their memory is used again
    Stopwatch watch_;
};

}  // namespace hts::cli
