#include <seiche/config/data/matrix_market.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

namespace seiche {
namespace {

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file)
      : name_(shortened_path(file.string())),
        input_(open_matrix_file(file)),
        bytes_(static_cast<double>(std::filesystem::file_size(file))) {}

  MatrixSizes sizes() {
    read_header();
    read_sizes();
    return {rows_, columns_, count_};
  }

  SparseMatrix read(bool* repeats) {
    sizes();
    if (is_array_) {
      read_array();
    } else {
      read_coordinates();
    }
    if (next_line()) complain("more entries follow than the {} announced", count_);
    SparseMatrix a(rows_, columns_);
    a.setFromTriplets(entries_.begin(), entries_.end());
    if (repeats != nullptr) *repeats = a.nonZeros() < std::ssize(entries_);
    return a;
  }

 private:
  template <class... Args>
  [[noreturn]] void complain(fmt::format_string<Args...> format, Args&&... args) const {
    throw Error("{}:{}: {}", name_, line_, fmt::format(format, std::forward<Args>(args)...));
  }

  std::string one_of(const std::string& word, const std::vector<std::string>& allowed) const {
    std::string lower = word;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (std::find(allowed.begin(), allowed.end(), lower) == allowed.end())
      complain("'{}' must be one of {}", shortened(word), fmt::join(allowed, ", "));
    return lower;
  }

  void read_header() {
    std::string text;
    std::getline(input_, text);
    ++line_;
    std::istringstream line(text);
    std::string banner, object, format, field, symmetry;
    line >> banner >> object >> format >> field >> symmetry;
    if (banner != "%%MatrixMarket")
      complain("a Matrix Market file begins with '%%MatrixMarket matrix coordinate real symmetric', or the like");
    one_of(object, {"matrix"});
    is_array_ = one_of(format, {"coordinate", "array"}) == "array";
    is_pattern_ = one_of(field, is_array_ ? std::vector<std::string>{"real", "integer"}
                                          : std::vector<std::string>{"real", "integer", "pattern"}) == "pattern";
    const std::string kind = one_of(symmetry, {"general", "symmetric", "skew-symmetric"});
    is_symmetric_ = kind == "symmetric";
    is_skew_ = kind == "skew-symmetric";
  }

  // Into words_: the next line that is neither empty nor a comment.
  bool next_line() {
    std::string text;
    while (std::getline(input_, text)) {
      ++line_;
      if (text.starts_with('%')) continue;
      std::istringstream line(text);
      words_.clear();
      for (std::string word; line >> word;) words_.push_back(word);
      if (!words_.empty()) return true;
    }
    return false;
  }

  void require_line(std::size_t words, Index done) {
    if (!next_line()) complain("the file ends after {} of {} entries", done, count_);
    if (words_.size() != words) complain("{} numbers are expected here, and there are {}", words, words_.size());
  }

  template <class Number>
  Number number(const std::string& word) const {
    Number value{};
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    const auto [rest, status] = std::from_chars(begin, word.data() + word.size(), value);
    if (word.starts_with("+-") || status != std::errc() || rest != word.data() + word.size())
      complain("'{}' is not a number", shortened(word));
    return value;
  }

  double value(const std::string& word) const {
    const double x = number<double>(word);
    if (!std::isfinite(x)) complain("the entry {} is not finite", shortened(word));
    return x;
  }

  void read_sizes() {
    const std::size_t words = is_array_ ? 2 : 3;
    if (!next_line() || words_.size() != words)
      complain("after the header stand {}", is_array_ ? "rows and columns" : "rows, columns and the number of entries");
    rows_ = number<Index>(words_[0]);
    columns_ = number<Index>(words_[1]);
    if (const std::string text = complaint_about_sizes(rows_, columns_); !text.empty()) complain("{}", text);
    const bool half = is_symmetric_ || is_skew_;
    if (half && rows_ != columns_)
      complain("a symmetric matrix must be square and this one is {} × {}", rows_, columns_);
    const Index full = !half ? rows_ * columns_ : is_skew_ ? rows_ * (rows_ - 1) / 2 : rows_ * (rows_ + 1) / 2;
    count_ = is_array_ ? full : number<Index>(words_[2]);
    if (count_ < 0) complain("{} entries are not possible", count_);
    if (static_cast<double>(count_) * 2 > bytes_)
      complain("{} entries do not fit into the {:.0f} bytes of this file", count_, bytes_);
  }

  void add(Index i, Index j, double x) {
    if (is_skew_ && i == j && x != 0) complain("a skew-symmetric matrix has no entry ({}, {}) = {}", i + 1, j + 1, x);
    entries_.emplace_back(static_cast<int>(i), static_cast<int>(j), x);
    if ((is_symmetric_ || is_skew_) && i != j)
      entries_.emplace_back(static_cast<int>(j), static_cast<int>(i), is_skew_ ? -x : x);
  }

  void read_coordinates() {
    for (Index k = 0; k < count_; ++k) {
      require_line(is_pattern_ ? 2 : 3, k);
      const Index i = number<Index>(words_[0]);
      const Index j = number<Index>(words_[1]);
      if (i < 1 || i > rows_ || j < 1 || j > columns_)
        complain("there is no entry ({}, {}) in a matrix of {} × {}", i, j, rows_, columns_);
      if ((is_symmetric_ || is_skew_) && j > i)
        complain("of a symmetric matrix the file holds the lower triangle, and ({}, {}) is above it", i, j);
      add(i - 1, j - 1, is_pattern_ ? 1.0 : value(words_[2]));
    }
  }

  void read_array() {
    Index k = 0;
    for (Index j = 0; j < columns_; ++j)
      for (Index i = is_skew_ ? j + 1 : is_symmetric_ ? j : 0; i < rows_; ++i, ++k) {
        require_line(1, k);
        if (const double x = value(words_[0]); x != 0) add(i, j, x);
      }
  }

  std::string name_;
  std::ifstream input_;
  double bytes_;
  std::size_t line_ = 0;
  std::vector<std::string> words_;
  bool is_array_ = false, is_pattern_ = false, is_symmetric_ = false, is_skew_ = false;
  Index rows_ = 0, columns_ = 0, count_ = 0;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

MatrixSizes matrix_market_sizes(const std::filesystem::path& file) { return Reader(file).sizes(); }

SparseMatrix read_matrix_market(const std::filesystem::path& file, bool* repeats) { return Reader(file).read(repeats); }

}  // namespace seiche
