#pragma once

// For the one file of a program that knows its command line; CLI11's header is heavy.

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace kiln {

/// A number within the bounds. CLI11's own Range lets NaN through.
[[nodiscard]] inline CLI::Validator within(double low, double high) {
  return {[=](std::string& text) {
            double value = 0.0;
            if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high)
              return std::string();
            return fmt::format("'{}' is not a number from {} to {}", text, low, high);
          },
          fmt::format("NUMBER in [{} - {}]", low, high)};
}

/// A whole number from 0 to `most`: no sign, nothing clamped.
[[nodiscard]] inline CLI::Validator wholeUpTo(std::uint64_t most) {
  return {[=](std::string& text) {
            std::uint64_t value = 0;
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            if (error == std::errc() && stop == end && value <= most) return std::string();
            return fmt::format("'{}' is not a whole number from 0 to {}", text, most);
          },
          fmt::format("WHOLE in [0 - {}]", most)};
}

[[nodiscard]] inline CLI::Validator notEmpty() {
  return {[](std::string& text) { return text.empty() ? "must not be empty" : std::string(); },
          "TEXT"};
}

/// Reads the command line; prints help, version or what is wrong.
/// @return the exit status with which to end at once: 0 after help, 2 for bad input; nullopt: go
/// on.
[[nodiscard]] inline std::optional<int> parseCommandLine(CLI::App& app, int argc, char** argv) {
  constexpr int kBadInput = 2;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
  }
  return std::nullopt;
}

}  // namespace kiln
