#include "globe/scene/track_file.h"

#include <gtest/gtest.h>
#include <minizip/zip.h>
#include <rapidcheck/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "tests/temporary_folder.h"
#include "tests/unit/scene/expect_refusal.h"

namespace globe::scene {
namespace {

std::string kml(const std::string& inside) {
  return "<?xml version=\"1.0\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\" "
         "xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n" +
         inside + "\n</kml>\n";
}

std::string tour(const std::string& steps) {
  return kml("<Document><gx:Tour><gx:Playlist>\n" + steps + "\n</gx:Playlist></gx:Tour></Document>");
}

const char* const kCamera =
    "<Camera><longitude>7</longitude><latitude>46</latitude><altitude>3000</altitude><heading>30</heading>"
    "<tilt>80</tilt><altitudeMode>absolute</altitudeMode></Camera>";
const char* const kLookAt =
    "<LookAt><longitude>8</longitude><latitude>46</latitude><heading>90</heading><tilt>60</tilt>"
    "<range>5000</range></LookAt>";

std::string fly_to(const std::string& view, const std::string& duration, const std::string& mode = "") {
  return "<gx:FlyTo><gx:duration>" + duration + "</gx:duration>" +
         (mode.empty() ? "" : "<gx:flyToMode>" + mode + "</gx:flyToMode>") + view + "</gx:FlyTo>\n";
}

TEST(Kml, ToursFlyAndWait) {
  const auto keys = read_kml(tour(fly_to(kCamera, "9") + "<gx:Wait><gx:duration>2</gx:duration></gx:Wait>\n" +
                                  fly_to(kLookAt, "4", "smooth") + fly_to(kCamera, "3", "smooth")),
                             "t.kml", std::nullopt);
  ASSERT_EQ(keys.size(), 4u);
  EXPECT_EQ(keys[0].time_s, 0.0);  // where it begins takes no time
  EXPECT_EQ(keys[0].place.h_m, 3000.0);
  EXPECT_FALSE(keys[0].above_ground);
  EXPECT_EQ(keys[0].look->heading_deg, 30.0);
  EXPECT_EQ(keys[0].look->pitch_deg, -10.0);
  EXPECT_TRUE(keys[0].stop);
  EXPECT_EQ(keys[1].time_s, 2.0);
  EXPECT_EQ(keys[1].place.lat_deg, 46.0);
  EXPECT_EQ(keys[2].time_s, 6.0);
  EXPECT_FALSE(keys[2].stop);
  EXPECT_EQ(keys[2].range_m, 5000.0);
  EXPECT_TRUE(keys[2].above_ground);  // clampToGround unless said
  EXPECT_EQ(keys[2].line, 6);
  EXPECT_TRUE(keys[3].stop);  // where it ends
}

TEST(Kml, OnlySmoothFlightsOneAfterTheOtherGoOnWithoutARest) {
  const auto rests = [](const std::vector<std::string>& modes) {
    std::string steps = fly_to(kCamera, "1", "smooth");
    for (const std::string& mode : modes) {
      steps += mode == "wait"   ? "<gx:Wait><gx:duration>1</gx:duration></gx:Wait>"
               : mode == "jump" ? fly_to(kLookAt, "0", "smooth")
                                : fly_to(kLookAt, "1", mode);
    }
    std::vector<bool> rest;
    for (const PathKey& key : read_kml(tour(steps), "t.kml", std::nullopt)) rest.push_back(key.stop);
    return rest;
  };
  using Rests = std::vector<bool>;
  EXPECT_EQ(rests({"smooth", "smooth", "smooth"}), (Rests{true, false, false, true}));
  EXPECT_EQ(rests({"smooth", "bounce", "smooth"}), (Rests{true, true, true, true}));
  EXPECT_EQ(rests({"smooth", "", "smooth", "smooth"}), (Rests{true, true, true, false, true}));
  EXPECT_EQ(rests({"smooth", "wait", "smooth"}), (Rests{true, true, true, true}));
  EXPECT_EQ(rests({"smooth", "jump", "smooth", "smooth"}), (Rests{true, true, true, false, true}));
}

TEST(Kml, FlightsInNoTimeAreJumps) {
  const auto keys = read_kml(tour(fly_to(kCamera, "9") + fly_to(kLookAt, "0") +
                                  "<gx:Wait><gx:duration>2</gx:duration></gx:Wait>" + fly_to(kCamera, "3")),
                             "t.kml", std::nullopt);
  ASSERT_EQ(keys.size(), 4u);
  EXPECT_FALSE(keys[0].jump);
  EXPECT_TRUE(keys[1].jump);
  EXPECT_EQ(keys[1].time_s, 0.0);
  EXPECT_FALSE(keys[2].jump);
  EXPECT_EQ(keys[2].time_s, 2.0);
  EXPECT_EQ(keys[3].time_s, 5.0);
}

TEST(Kml, CamerasRollTheOtherWay) {
  const std::string leaning = "<Camera><latitude>46</latitude><roll>-20</roll></Camera>";
  const auto keys = read_kml(tour(fly_to(leaning, "1") + fly_to(kCamera, "1")), "t.kml", std::nullopt);
  EXPECT_EQ(keys[0].roll_deg, 20.0);  // KML counts counter-clockwise
  EXPECT_EQ(keys[1].roll_deg, 0.0);
}

TEST(Kml, LinesAndTracksArePathsToo) {
  const auto line =
      read_kml(kml("<Placemark><LineString><altitudeMode>absolute</altitudeMode><coordinates>7,46,100 "
                   "8,46,200\n9,46</coordinates></LineString></Placemark>"),
               "t.kml", std::nullopt);
  ASSERT_EQ(line.size(), 3u);
  EXPECT_EQ(line[1].place.lon_deg, 8.0);
  EXPECT_EQ(line[1].place.h_m, 200.0);
  EXPECT_FALSE(line[0].time_s.has_value());
  const auto track =
      read_kml(kml("<gx:Track><when>2026-01-01T00:00:00Z</when><when>2026-01-01T00:01:00Z</when>"
                   "<gx:coord>7 46 5</gx:coord><gx:coord>8 46 5</gx:coord></gx:Track>"),
               "t.kml", true);
  ASSERT_EQ(track.size(), 2u);
  EXPECT_NEAR(*track[1].time_s, 60.0, 1e-4);
  EXPECT_TRUE(track[0].above_ground);
  EXPECT_EQ(track[0].place.h_m, 5.0);
}

TEST(Kml, WhatIsWrongIsToldByItsLine) {
  const struct {
    std::string text, begin, part;
  } cases[]{
      {"<kml>\n<a>\n</b>\n</kml>", "t.kml:3", "no XML"},
      {"", "t.kml:1", "no XML"},
      {kml("<Placemark/>"), "t.kml", "there is no gx:Tour, gx:Track or LineString"},
      {tour(""), "t.kml:1", "no place"},
      {tour(fly_to(kCamera, "1")), "t.kml:4", "one place"},
      {tour(fly_to("", "1")), "t.kml:4", "without a view"},
      {tour(fly_to(kCamera, "soon")), "t.kml:4", "\"soon\", not a number"},
      {tour(fly_to(kCamera, "nan")), "t.kml:4", "not a number"},
      {tour(fly_to(kCamera, "1") + fly_to(kCamera, "0")), "t.kml:5", "takes no time"},
      {tour(fly_to(kCamera, "1") + fly_to(kCamera, "1", "glide")), "t.kml:5", "glide"},
      {tour(fly_to("<Camera><roll>181</roll></Camera>", "1")), "t.kml:4", "roll"},
      {tour(fly_to(kCamera, "1") + fly_to(kCamera, "-1")), "t.kml:5", "negative"},
      {tour(fly_to("<LookAt><latitude>1</latitude></LookAt>", "1")), "t.kml:4", "range"},
      {tour(fly_to("<Camera><latitude>91</latitude></Camera>", "1") + fly_to(kCamera, "1")), "t.kml:4",
       "latitude"},
      {tour(fly_to("<Camera><tilt>181</tilt></Camera>", "1")), "t.kml:4", "tilt"},
      {tour(fly_to("<Camera><altitudeMode>high</altitudeMode></Camera>", "1")), "t.kml:4", "high"},
      {kml("<LineString><coordinates>7,x</coordinates></LineString>"), "t.kml:3", "7,x"},
      {kml("<gx:Track><when>2026-01-01</when><gx:coord>7 46 5</gx:coord>\n<gx:coord>8 46 "
           "5</gx:coord></gx:Track>"),
       "t.kml:3", "2 places and 1 times"},
      {kml("<gx:Track><when>\nnoon</when></gx:Track>"), "t.kml:3", "noon"},
  };
  for (const auto& [text, begin, part] : cases)
    scene_tests::expect_refusal([&text = text] { read_kml(text, "t.kml", std::nullopt); }, begin, part);
}

TEST(Kml, EntityBombsAndDeepNestsDoNoHarm) {
  std::string bomb = "<!DOCTYPE kml [<!ENTITY a0 \"ha\">";
  for (int k = 1; k < 40; ++k) {
    const std::string name = std::to_string(k - 1);
    bomb += "<!ENTITY a" + std::to_string(k) + " \"&a" + name + ";&a" + name + ";\">";
  }
  bomb += "]><kml><LineString><coordinates>&a39;</coordinates></LineString></kml>";
  scene_tests::expect_refusal([&] { read_kml(bomb, "t.kml", std::nullopt); }, "t.kml:1");
  std::string nest;
  for (int k = 0; k < 200'000; ++k) nest += "<a>";
  scene_tests::expect_refusal([&] { read_kml(nest, "t.kml", std::nullopt); }, "t.kml:1");
  std::string closed = nest;
  for (int k = 0; k < 200'000; ++k) closed += "</a>";
  scene_tests::expect_refusal([&] { read_kml(closed, "t.kml", std::nullopt); }, "t.kml");
}

std::string gpx(const std::string& points) {
  return "<gpx version=\"1.1\" xmlns=\"http://www.topografix.com/GPX/1/1\">\n<trk><trkseg>\n" + points +
         "</trkseg></trk></gpx>\n";
}

TEST(Gpx, TracksHavePlacesHeightsAndTimes) {
  const auto keys =
      read_gpx(gpx("<trkpt lat=\"46\" lon=\"7\"><ele>500</ele><time>2026-01-01T00:00:00Z</time></trkpt>\n"
                   "<trkpt lat=\"46\" lon=\"7\"><ele>501</ele><time>2026-01-01T00:00:00Z</time></trkpt>\n"
                   "<trkpt lat=\"46.1\" lon=\"7\"><time>2026-01-01T00:00:10.5Z</time></trkpt>\n"),
               "t.gpx", std::nullopt);
  ASSERT_EQ(keys.size(), 2u);  // two places for one second are one
  EXPECT_EQ(keys[0].place.h_m, 500.0);
  EXPECT_NEAR(*keys[1].time_s, 10.5, 1e-4);
}

TEST(Gpx, WhatIsWrongIsToldByItsLine) {
  const std::string good = "<trkpt lat=\"46\" lon=\"7\"><time>2026-01-01T00:00:09Z</time></trkpt>\n";
  const struct {
    std::string text, begin, part;
  } cases[]{{gpx(""), "t.gpx", "no track"},
            {gpx(good), "t.gpx:3", "one place"},
            {gpx(good + "<trkpt lat=\"46\"/>"), "t.gpx:4", "lon"},
            {gpx(good + "<trkpt lat=\"-91\" lon=\"7\"><time>2026-01-01T00:01:00Z</time></trkpt>"), "t.gpx:4",
             "latitude"},
            {gpx(good + "<trkpt lat=\"46\" lon=\"7\"/>"), "t.gpx:4", "some have none"},
            {gpx(good + "<trkpt lat=\"46\" lon=\"7\"><time>2026-01-01T00:00:00Z</time></trkpt>"), "t.gpx:4",
             "later"},
            {gpx(good + "<trkpt lat=\"46\" lon=\"7\"><ele>high</ele></trkpt>"), "t.gpx:4", "high"}};
  for (const auto& [text, begin, part] : cases)
    scene_tests::expect_refusal([&text = text] { read_gpx(text, "t.gpx", std::nullopt); }, begin, part);
}

TEST(TrackCsv, ColumnsAreFoundByName) {
  const auto keys =
      read_track_csv("Time,Longitude,Latitude,Ele,heading,pitch\n0,7,46,100,90,-5\n2.5,8,46,200,91,-6\n",
                     "t.csv", std::nullopt);
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[1].time_s, 2.5);
  EXPECT_EQ(keys[1].place.lon_deg, 8.0);
  EXPECT_EQ(keys[1].look->pitch_deg, -6.0);
  EXPECT_EQ(keys[1].line, 3);
  const auto dated = read_track_csv(
      "lat,lon,alt,time\n1,2,3,2026-01-01T00:00:00Z\n1,3,3,2026-01-01T00:00:30Z\n", "t.csv", true);
  EXPECT_NEAR(*dated[1].time_s, 30.0, 1e-4);
}

TEST(TrackCsv, WhatIsWrongIsToldByItsLine) {
  const struct {
    std::string text, begin, part;
  } cases[]{{"", "t.csv:1", "no place"},
            {"lat,lon\n1,2\n", "t.csv:1", "lat, lon and alt"},
            {"lat,lon,alt,heading\n", "t.csv:1", "belong together"},
            {"lat,lon,alt\n1,2,3\n", "t.csv:2", "one place"},
            {"lat,lon,alt\n1,2,3\n1,2\n", "t.csv:3", "alt is \"\""},
            {"lat,lon,alt\n1,2,3\n1,inf,3\n", "t.csv:3", "lon"},
            {"lat,lon,alt\n1,2,3\n99,2,3\n", "t.csv:3", "latitude"},
            {"lat,lon,alt,time\n1,2,3,0\n1,2,3,noon\n", "t.csv:3", "noon"},
            {"lat,lon,alt,time\n1,2,3,9\n1,2,3,8\n", "t.csv:3", "later"},
            {"lat,lon,alt\n1,2,3\n\"1,2,3\n", "t.csv:3", "quote"},
            {"lat,lon,alt,heading,pitch\n1,2,3,0,91\n", "t.csv:2", "pitch"}};
  for (const auto& [text, begin, part] : cases)
    scene_tests::expect_refusal([&text = text] { read_track_csv(text, "t.csv", std::nullopt); }, begin, part);
}

TEST(TrackFile, IsToldByItsEnding) {
  const tests::TemporaryFolder folder;
  std::ofstream(folder / "a.CSV") << "lat,lon,alt\n1,2,3\n1,3,3\n";
  EXPECT_EQ(read_track_file(folder / "a.CSV", std::nullopt).size(), 2u);
  scene_tests::expect_refusal([&] { read_track_file(folder / "a.fit", std::nullopt); },
                              (folder / "a.fit").string(), ".kmz");
}

/// A zip archive of files by name, packed.
void write_archive(const std::filesystem::path& path,
                   const std::vector<std::pair<std::string, std::string>>& files) {
  const zipFile archive = zipOpen64(path.c_str(), APPEND_STATUS_CREATE);
  ASSERT_NE(archive, nullptr);
  for (const auto& [name, text] : files) {
    ASSERT_EQ(zipOpenNewFileInZip(archive, name.c_str(), nullptr, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED,
                                  Z_BEST_SPEED),
              ZIP_OK);
    ASSERT_EQ(zipWriteInFileInZip(archive, text.data(), static_cast<unsigned>(text.size())), ZIP_OK);
    zipCloseFileInZip(archive);
  }
  ASSERT_EQ(zipClose(archive, nullptr), ZIP_OK);
}

TEST(Kmz, TheFirstKmlAtTheTopIsRead) {
  const tests::TemporaryFolder folder;
  const std::string flight = tour(fly_to(kCamera, "1") + fly_to(kLookAt, "4"));
  write_archive(folder / "a.KMZ", {{"files/other.kml", tour("")},
                                   {"files/picture.png", std::string(100'000, 'x')},
                                   {"doc.kml", flight},
                                   {"more.kml", tour("")}});
  EXPECT_EQ(read_track_file(folder / "a.KMZ", std::nullopt).size(), 2u);
  write_archive(folder / "b.kmz", {{"tour/flight.KML", flight}});
  EXPECT_EQ(read_track_file(folder / "b.kmz", std::nullopt).size(), 2u);
}

TEST(Kmz, WhatIsWrongIsToldInOneLine) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path file = folder / "a.kmz";
  const auto refused = [&](const std::string& begin, const std::string& part) {
    scene_tests::expect_refusal([&] { read_track_file(file, std::nullopt); }, file.string() + begin, part);
  };
  refused("", "zip archive");
  std::ofstream(file) << "<kml/>";
  refused("", "zip archive");
  write_archive(file, {{"readme.txt", "nothing"}});
  refused("", "no .kml");
  write_archive(file, {{"doc.kml", tour(fly_to(kCamera, "1") + fly_to(kCamera, "soon"))}});
  refused("/doc.kml:5", "\"soon\", not a number");
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  bytes[bytes.find("doc.kml") + 12] ^= 0x55;  // in what is packed
  std::ofstream(file, std::ios::binary) << bytes;
  refused("/doc.kml", "damaged");
  write_archive(file, {{"doc.kml", std::string(65u << 20, ' ')}});  // 64 KiB packed
  refused("/doc.kml", "longer than 64 MiB");
}

RC_GTEST_PROP(TrackCsv, ReadsBackWhatIsWritten, (const std::vector<std::pair<int, int>>& steps)) {
  RC_PRE(steps.size() > 1);
  std::string text = "lat,lon,alt,time\n";
  for (std::size_t k = 0; k < steps.size(); ++k)
    text += std::to_string(steps[k].first % 90) + "," + std::to_string(steps[k].second % 180) + ",5," +
            std::to_string(k) + "\n";
  const auto keys = read_track_csv(text, "t.csv", std::nullopt);
  RC_ASSERT(keys.size() == steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    RC_ASSERT(keys[k].place.lat_deg == steps[k].first % 90);
    RC_ASSERT(keys[k].time_s == static_cast<double>(k));
  }
}

}  // namespace
}  // namespace globe::scene
