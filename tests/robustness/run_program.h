// Runs a program as a user's shell would, and keeps what it printed.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rheocyte::test {

struct Command {
  std::vector<std::string> arguments;                ///< the first one is the program
  std::map<std::string, std::string> environment{};  ///< in addition to ours
  long max_file_bytes = -1;                          ///< a file may not grow beyond this, as on a full disk
  std::filesystem::path folder{};                    ///< the current one while it runs; empty: ours
  int signal = 0;                                    ///< sent once the program has printed to standard error
};

struct Ended {
  int exit_code = -1;  ///< 128 + number if a signal ended it
  std::string out, err;
  double seconds = 0;
};

Ended run(const Command&);

/// A new empty folder that is removed with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string content_of(const std::filesystem::path&);
void write_file(const std::filesystem::path&, const std::string& content);

/// The program has ended with this code and printed one line that holds these words to standard error, and nothing
/// else.
void expect_sentence(const Ended&, const std::string& words, int exit_code = 2);

/// Whether the text is exactly one line that ends with a newline.
bool is_one_line(const std::string& text);

}  // namespace rheocyte::test
