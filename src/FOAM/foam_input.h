/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_INPUT_H
#define LMP_FOAM_INPUT_H

#include "error.h"
#include "lmptype.h"
#include "utils.h"

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

// The arguments of an input command: words that are what they should be, or an error that names the
// style, the argument and what is allowed.  What a number looks like, LAMMPS' utils say; their own errors do not
// name the argument.
//
//   FoamInput input(error, "Pair style durian/foam", narg, arg);
//   mu0 = input.argument("mu0").number(FoamInput::ABOVE, 0.0);
//   input.keywords({{"rin", [&](const FoamInput::Value &v) { rin = v.number(...); }}, ...});

class FoamInput {
 public:
  enum Compare { ABOVE, AT_LEAST };

  // as a message shows a word: one of any length must not hide the rest

  static std::string shown(const std::string &word)
  {
    constexpr size_t MOST = 40;
    if (word.empty()) return "an empty word";
    return word.size() > MOST ? word.substr(0, MOST) + "..." : word;
  }

  class Value {
   public:
    // a finite number COMPARE limit

    double number(Compare compare, double limit) const
    {
      return number(fmt::format("a number {} {}", compare == ABOVE ? ">" : ">=", limit),
                    [=](double x) { return compare == ABOVE ? x > limit : x >= limit; });
    }
    double number() const    // a finite one
    {
      return number("a number", [](double) { return true; });
    }
    double between(double lo, double hi) const    // neither lo nor hi
    {
      return number(fmt::format("a number > {} and < {}", lo, hi),
                    [=](double x) { return x > lo && x < hi; });
    }

    double from_to(double lo, double hi) const    // or one of these
    {
      return number(fmt::format("a number >= {} and <= {}", lo, hi),
                    [=](double x) { return x >= lo && x <= hi; });
    }

    bigint count() const { return integer(0, MAXBIGINT, "an integer >= 0"); }
    int integer(int from, int to) const
    {
      return static_cast<int>(integer(from, to, fmt::format("an integer from {} to {}", from, to)));
    }

    // is it this word? If not, it may be what is asked for next.

    bool is(const std::string &word) const
    {
      other_words += word + " or ";
      return !missing && text == word;
    }

    // which of these words is it?

    int one_of(const std::vector<std::string> &words) const
    {
      std::string allowed;
      for (const auto &word : words) allowed += (allowed.empty() ? "" : " or ") + word;
      given(allowed);
      for (size_t n = 0; n < words.size(); n++)
        if (text == words[n]) return static_cast<int>(n);
      refuse(allowed);
    }

    std::string word(const std::string &allowed) const { return given(allowed); }
    [[noreturn]] void reject(const std::string &allowed) const { refuse(allowed); }

    // types of atoms, as N, *, N*, *M or N*M

    std::pair<int, int> types(int most) const
    {
      const std::string allowed = fmt::format("a type from 1 to {} or a range of them", most);
      given(allowed);
      const size_t star = text.find('*');
      auto end = [&](const std::string &part, int otherwise) {
        if (part.empty() && star != std::string::npos) return otherwise;
        if (!utils::is_integer(part) || part.size() > 9) refuse(allowed);
        return std::stoi(part);
      };
      const int lo = end(text.substr(0, star), 1);
      const int hi = star == std::string::npos ? lo : end(text.substr(star + 1), most);
      if (lo < 1 || hi > most || lo > hi) refuse(allowed);
      return {lo, hi};
    }

   private:
    friend class FoamInput;
    Error *error;
    std::string style, name, text;
    bool keyword, missing;
    mutable std::string other_words;

    Value(Error *error, const std::string &style, const std::string &name, const char *word,
          bool keyword)
        : error(error), style(style), name(name), text(word ? word : ""), keyword(keyword),
          missing(!word)
    {
    }

    const char *given(const std::string &allowed) const
    {
      if (missing && keyword)
        error->all(FLERR, "{}: keyword {} needs a value: {}", style, name, other_words + allowed);
      if (missing)
        error->all(FLERR, "{}: argument {} is missing: {}", style, name, other_words + allowed);
      return text.c_str();
    }

    [[noreturn]] void refuse(const std::string &allowed, const char *why = "") const
    {
      error->all(FLERR, "{}: {} must be {}, not {}{}", style, name, other_words + allowed,
                 shown(text), why);
    }

    template <class Allows> double number(const std::string &allowed, const Allows &allows) const
    {
      const double x = std::strtod(given(allowed), nullptr);
      const bool a_number = utils::is_double(text);
      if (!a_number || !std::isfinite(x) || !allows(x))
        refuse(allowed, a_number && std::isinf(x) ? ", which is too large" : "");
      return x;
    }

    bigint integer(bigint from, bigint to, const std::string &allowed) const
    {
      errno = 0;
      const bigint n = std::strtoll(given(allowed), nullptr, 10);
      if (!utils::is_integer(text) || errno || n < from || n > to) refuse(allowed);
      return n;
    }
  };

  using Keywords = std::vector<std::pair<std::string, std::function<void(const Value &)>>>;

  FoamInput(Error *error, const std::string &style, int narg, char **arg)
      : error(error), style(style), narg(narg), arg(arg)
  {
  }

  Value argument(const std::string &name) { return {error, style, name, next(), false}; }

  // a word that may follow, and is taken if it does

  bool option(const std::string &word)
  {
    const bool there = iarg < narg && arg[iarg] == word;
    if (there) iarg++;
    return there;
  }

  // all that is left: pairs of a keyword and its value; the last counts

  void keywords(const Keywords &all)
  {
    while (iarg < narg) {
      const std::string keyword = next();
      std::string allowed;
      bool found = false;
      for (const auto &[name, take] : all) {
        allowed += (allowed.empty() ? "" : ", ") + name;
        if (name != keyword) continue;
        take({error, style, name, next(), true});
        found = true;
      }
      if (!found)
        error->all(FLERR, "{}: unknown keyword {} (allowed are {})", style, shown(keyword),
                   allowed);
    }
  }

 private:
  Error *error;
  std::string style;
  int narg, iarg = 0;
  char **arg;

  const char *next() { return iarg < narg ? arg[iarg++] : nullptr; }
};

}    // namespace LAMMPS_NS

#endif
