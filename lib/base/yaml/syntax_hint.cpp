#include "yaml/syntax_hint.hpp"

#include <vector>

namespace avoidbench {
namespace {

struct Place {
  int line = 1, column = 1;
};

struct Bracket {
  char sign = '[';
  Place place;
};

char closing(char open) { return open == '[' ? ']' : '}'; }

std::string quoted(char sign) { return {'\'', sign, '\''}; }

/// Goes through a document sign by sign, past quotes and comments.
/// It knows just enough YAML to tell brackets and quotes that structure a document from those that
/// are letters of a text. It is asked only about documents that the library has refused, so what it
/// takes for wrong by mistake never refuses a good one.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& source) : text_(text), source_(source) {}

  // The first thing that is wrong, or else the innermost bracket that the end leaves open.
  std::optional<InputProblem> problem() {
    for (; at_ < text_.size() && !found_; step()) look();
    if (found_ || open_.empty()) return found_;
    const Bracket& last = open_.back();
    refuse(last.place, quoted(last.sign) + " is never closed by " + quoted(closing(last.sign)));
    return found_;
  }

 private:
  void refuse(Place place, const std::string& why) {
    found_ = {source_, place.line, place.column, "not valid YAML: " + why};
  }

  void step() {
    const char c = text_[at_++];
    if (c == '\n') {
      place_ = {.line = place_.line + 1, .column = 1};
      is_indent_ = true;
      before_ = '\n';
      return;
    }
    // Only the first byte of a character counts as a column.
    if ((static_cast<unsigned char>(c) & 0xc0U) != 0x80U) ++place_.column;
    if (c == ' ' || c == '\t') {
      is_after_space_ = true;
      return;
    }
    is_indent_ = is_after_space_ = false;
    before_ = skipped_ ? *skipped_ : c;
    skipped_.reset();
  }

  /// Whether a value begins here: quotes and brackets within plain words are letters.
  bool begins_value() const {
    if (!open_.empty()) return before_ == '[' || before_ == '{' || before_ == ',' || before_ == ':';
    const bool is_behind_sign = before_ == ':' || before_ == '-' || before_ == '?';
    return before_ == '\n' || (is_behind_sign && is_after_space_);
  }

  // Looks at the sign that step() will go past; quotes, comments and words it skips itself.
  void look() {
    const char c = text_[at_];
    // Within brackets, lines may be indented by anything.
    if (c == '\t' && is_indent_ && open_.empty()) {
      refuse(place_, "a tab indents this line; YAML allows only spaces");
    } else if (c == '#' && (is_indent_ || is_after_space_)) {
      while (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') step();
    } else if ((c == '\'' || c == '"') && begins_value()) {
      skip_quoted(c);
    } else if ((c == '&' || c == '!') && begins_value()) {
      skip_word();
    } else if ((c == '[' || c == '{') && begins_value()) {
      open_.push_back({.sign = c, .place = place_});
    } else if ((c == ']' || c == '}') && (!open_.empty() || begins_value())) {
      // Outside of all brackets a closing one is a letter unless a value begins with it.
      close(c);
    }
  }

  void close(char c) {
    if (open_.empty()) return refuse(place_, quoted(c) + " closes nothing");
    const Bracket last = open_.back();
    open_.pop_back();
    if (closing(last.sign) == c) return;
    refuse(place_, quoted(c) + " where " + quoted(closing(last.sign)) + " is expected for the " +
                       quoted(last.sign) + " of line " + std::to_string(last.place.line) +
                       ", column " + std::to_string(last.place.column));
  }

  /// Past an anchor or tag, behind which a value may still begin.
  void skip_word() {
    const char before = before_;
    while (at_ + 1 < text_.size() && text_.substr(at_ + 1, 1).find_first_of(" \t\n") != 0) step();
    skipped_ = before;
  }

  // Up to the closing quote. Within "…" a backslash and within '…' a second quote take the sign
  // behind them with them.
  void skip_quoted(char quote) {
    const Place begin = place_;
    step();
    while (at_ < text_.size()) {
      const bool is_escape = quote == '"' && text_[at_] == '\\';
      const bool is_double = quote == '\'' && text_.substr(at_, 2) == "''";
      // The caller steps over the closing quote.
      if (text_[at_] == quote && !is_double) return;
      step();
      if ((is_escape || is_double) && at_ < text_.size()) step();
    }
    refuse(begin, "the quote " + std::string(1, quote) + " is never closed");
  }

  std::string_view text_;
  const std::string& source_;
  std::size_t at_ = 0;
  Place place_;
  char before_ = '\n';           // the last sign that is no space
  std::optional<char> skipped_;  // what was before an anchor or tag that ends here
  bool is_indent_ = true, is_after_space_ = false;
  std::vector<Bracket> open_;
  std::optional<InputProblem> found_;
};

}  // namespace

std::optional<InputProblem> syntax_hint(std::string_view text, const std::string& source) {
  return Scanner(text, source).problem();
}

}  // namespace avoidbench
