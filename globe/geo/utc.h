#pragma once

#include <string>

namespace globe::geo {

/// A UTC date and time as ERFA takes it: the sum of both is a quasi Julian date, in which a day with a leap
/// second is as long as any other.
struct UtcDate {
  double day = 0;
  double rest = 0;
};

/// Reads ISO 8601: "2026-03-21", "2026-03-21T10:00[:SS[.sss]]", with "Z" or "+hh:mm"; without a zone UTC.
/// @param what  whose time it is, for messages, such as "--time"
/// Throws UsageError for anything else or a date that does not exist.
UtcDate parse_utc(const std::string& iso8601, const std::string& what = "time");

/// "2026-03-21T10:00:00Z", to the nearest second.
std::string iso8601(const UtcDate& date);

/// Seconds from one date to another, leap seconds left out; exact to a microsecond within a century.
double seconds_between(const UtcDate& from, const UtcDate& to);

/// A date so many seconds later.
UtcDate later_by(const UtcDate& date, double seconds);

}  // namespace globe::geo
