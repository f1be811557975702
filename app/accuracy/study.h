#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace globe::gl {
class Context;
}
namespace globe::planet {
class Surface;
}

namespace app::accuracy {

/// How far a setting is from the reference over the sample of its study, in the study's unit.
struct ErrorFigure {
  double max = 0;
  double rms = 0;
  std::string where;  ///< in the sample the largest one was
};

/// Gathers an ErrorFigure.
class ErrorSum {
 public:
  /// `place` gives words for where the error was; asked only of the largest so far.
  template <typename Place>
  void add(double error, const Place& place) {
    squares_ += error * error;
    ++count_;
    if (!(std::abs(error) > figure_.max) && count_ > 1) return;
    figure_.max = std::abs(error);
    figure_.where = place();
  }
  ErrorFigure figure() const {
    ErrorFigure result = figure_;
    if (count_ > 0) result.rms = std::sqrt(squares_ / static_cast<double>(count_));
    return result;
  }

 private:
  ErrorFigure figure_;
  double squares_ = 0;
  std::size_t count_ = 0;
};

/// One way to turn a knob.
struct Setting {
  std::string name;
  ErrorFigure error;
  std::function<double()> cost;  ///< of one more run, in the study's unit of cost
  bool is_default = false;
  std::string note = {};
  std::function<void()> release =
      {};  ///< frees what `cost` made, which makes it anew, unmeasured, when asked
};

/// A knob, what each of its settings costs and what it errs by.
struct Study {
  std::string name;       ///< "geodesics.ellipsoid"
  std::string title;      ///< for people
  std::string knob;       ///< the options that turn it, ", " between them, the command before them where
                          ///< other commands mean something else; "" where no option does
  std::string reference;  ///< what errors are measured against
  std::string sample;     ///< over what, the hard places in it
  std::string error_unit;
  std::string cost_unit;
  std::vector<Setting> settings;
};

/// How much is measured, and with what.
struct Scope {
  bool full = false;  ///< the sizes and levels of a report to be cited, in place of a look
  std::shared_ptr<globe::gl::Context> context = {};  ///< current, and stays so, where something is drawn
  std::shared_ptr<const globe::planet::Surface> planet = {};  ///< what is then drawn: the built-in one, once
};

/// Studies that belong together, by the word that --only takes.
struct Family {
  std::string name;
  std::function<std::vector<Study>(const Scope&)> studies;
  std::vector<std::string> knobs = {};           ///< Study::knob of its studies, known without running them
  std::vector<std::string> approximations = {};  ///< what no option turns: how names of its studies begin
  bool draws = false;                            ///< needs Scope::context and planet
};

/// All families, in the order of the report.
std::vector<Family> families();

std::vector<Study> geometry_studies(const Scope& scope);
std::vector<Study> geodesic_studies(const Scope& scope);
std::vector<Study> height_studies(const Scope& scope);
std::vector<Study> storage_studies(const Scope& scope);
std::vector<Study> conversion_studies(const Scope& scope);
std::vector<Study> question_studies(const Scope& scope);
std::vector<Study> cover_studies(const Scope& scope);
std::vector<Study> position_studies(const Scope& scope);
std::vector<Study> detail_studies(const Scope& scope);
std::vector<Study> morph_studies(const Scope& scope);
std::vector<Study> depth_studies(const Scope& scope);
std::vector<Study> dome_studies(const Scope& scope);
std::vector<Study> sample_studies(const Scope& scope);
std::vector<Study> window_studies(const Scope& scope);
std::vector<Study> sky_studies(const Scope& scope);
std::vector<Study> atmosphere_studies(const Scope& scope);
std::vector<Study> shading_studies(const Scope& scope);
std::vector<Study> flat_studies(const Scope& scope);
std::vector<Study> marks_studies(const Scope& scope);

/// Takes what work comes to, so that no compiler leaves it out.
inline void keep(double result) {
  static volatile double kept;
  kept = result;
  static_cast<void>(kept);
}

/// A cost that is the time of `work` for each of its `items`, in units of `unit_ns`.
inline std::function<double()> timed(double items, std::function<void()> work, double unit_ns = 1.0) {
  return [=, work = std::move(work)] {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count() /
           items / unit_ns;
  };
}

/// A cost that is what it is: bytes.
inline std::function<double()> fixed(double cost) {
  return [cost] { return cost; };
}

}  // namespace app::accuracy
