#include "globe/geo/point.h"

#include <gtest/gtest.h>

#include "globe/base/error.h"

namespace {

using globe::geo::parse_point;

TEST(Point, HemispheresMayStandApart) {
  for (const char* text : {"10.5 N 20.25 E", "10.5N 20.25E", "20.25 E 10.5 N", "N 10.5 E 20.25",
                           "10° 30' N 20° 15' 0\" E", "10.5 n, 20.25 e", "10.50000° N  20.25000° E"}) {
    const globe::geo::Point point = parse_point(text);
    EXPECT_DOUBLE_EQ(point.position.lat_deg, 10.5) << text;
    EXPECT_DOUBLE_EQ(point.position.lon_deg, 20.25) << text;
    EXPECT_FALSE(point.has_alt) << text;
  }
  EXPECT_DOUBLE_EQ(parse_point("10 S 20 W").position.lon_deg, -20.0);
}

TEST(Point, AnAltitudeMayFollowHemispheresThatStandApart) {
  for (const char* text : {"10.5 N 20.25 E 300 m", "10.5 N 20.25 E 300", "N 10.5 E 20.25 0.3km"}) {
    const globe::geo::Point point = parse_point(text);
    EXPECT_TRUE(point.has_alt) << text;
    EXPECT_DOUBLE_EQ(point.position.h_m, 300.0) << text;
    EXPECT_DOUBLE_EQ(point.position.lon_deg, 20.25) << text;
  }
}

TEST(Point, LettersThatMakeNoPlaceAreRefused) {
  for (const char* text :
       {"10 N 20 N", "N S 10 20", "10 N E 20", "10 20 N E", "N 10 20 E", "10 N 20 E 30 W", "N E"})
    EXPECT_THROW(parse_point(text), globe::UsageError) << text;
}

}  // namespace
