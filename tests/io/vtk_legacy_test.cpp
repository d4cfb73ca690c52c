#include "tets_testing.hpp"

namespace vtk_legacy_test {

using namespace io_testing;
using Catch::Contains;

namespace {

constexpr auto parse_vtk = io_testing::tets<plexway::io::parse_vtk>;

std::string points_text() {
  std::string text = "POINTS 6 double\n";
  for (const std::string& row : two_rows) text += row + " ";
  return text + "\n";
}

std::string head(const std::string& version, const std::string& mode) {
  return "# vtk DataFile Version " + version + "\nwhat: ever # it is\n" + mode +
         "\nDATASET UNSTRUCTURED_GRID\n";
}

const std::string cells3 = "CELLS 3 14\n3 0 1 2\n4 0 1 2 3\n4 1 0 2 5\n";
const std::string types3 = "CELL_TYPES 3\n5 10\n10\n";
const std::string cells5 =
    "CELLS 4 11\nOFFSETS vtktypeint64\n0 3 7 11\nCONNECTIVITY vtktypeint64\n0 1 2 0 1 2 3 1 0\n2 "
    "5\n";

std::string ascii3() { return head("3.0", "ASCII") + points_text() + cells3 + types3; }
std::string ascii5() { return head("5.1", "ASCII") + points_text() + cells5 + types3; }

template <class Real, class Index>
std::string binary(bool version5, const std::string& real, const std::string& index) {
  Packer points(true);
  for (const auto& p : two_positions)
    for (const double c : p) points.put(static_cast<Real>(c));
  Packer types(true);
  for (const std::int32_t t : {5, 10, 10}) types.put(t);
  std::string text = head(version5 ? "5.1" : "2.0", "BINARY") +
                     "FIELD FieldData 2\nTIME 1 1 double\n" + Packer(true).put(0.5).bytes() +
                     "\nMETADATA\nINFORMATION 0\n\nCYCLE 3 2 short\n" + std::string(12, '\n') +
                     "\nPOINTS 6 " + real + "\n" + points.bytes() +
                     "\nMETADATA\nINFORMATION 1\nNAME L2_NORM LOCATION vtk\nDATA 2 0 1\n \n";
  Packer cells(true);
  if (version5) {
    for (const std::int64_t i : {0, 3, 7, 11}) cells.put(static_cast<Index>(i));
    text += "\nCELLS 4 11\nOFFSETS " + index + "\n" + cells.bytes();
    Packer connectivity(true);
    for (const std::int64_t i : {0, 1, 2, 0, 1, 2, 3, 1, 0, 2, 5})
      connectivity.put(static_cast<Index>(i));
    text += "\nCONNECTIVITY " + index + "\n" + connectivity.bytes();
  } else {
    for (const std::int32_t i : {3, 0, 1, 2, 4, 0, 1, 2, 3, 4, 1, 0, 2, 5}) cells.put(i);
    text += "\nCELLS 3 14\n" + cells.bytes();
  }
  return text + "\nCELL_TYPES 3\n" + types.bytes() + "\nCELL_DATA 3\n";
}

std::string vtk_complaint(std::string_view bytes) { return complaint(parse_vtk, bytes); }

}  // namespace

TEST_CASE("vtk: ascii, both layouts of cells, any case, data behind the grid") {
  for (const std::string& text : {ascii3(), ascii5()}) {
    check_two(parse_vtk(text, "mesh"));
    check_two(parse_vtk(text + "POINT_DATA 6\nSCALARS d float\nnan\n", "mesh"));
    check_two(parse_vtk(replaced(text, "DATASET UNSTRUCTURED_GRID", "dataset Unstructured_Grid"),
                        "mesh"));
    check_two(parse_vtk(replaced(text, "\nCELLS",
                                 "\nMETADATA\nINFORMATION 0\n\nFIELD f 1\nTIME 1 1 double\n7\n"
                                 "CELLS"),
                        "mesh"));
  }
}

TEST_CASE("vtk: binary, numbers of any size") {
  check_two(parse_vtk(binary<double, std::int64_t>(false, "double", ""), "mesh"));
  check_two(parse_vtk(binary<float, std::int64_t>(false, "float", ""), "mesh"));
  check_two(parse_vtk(binary<double, std::int64_t>(true, "double", "vtktypeint64"), "mesh"));
  check_two(parse_vtk(binary<float, std::int32_t>(true, "float", "int"), "mesh"));
  check_two(parse_vtk(binary<float, std::uint8_t>(true, "float", "unsigned_char"), "mesh"));
}

TEST_CASE("vtk: quadratic tetrahedra lend their corners") {
  const std::string text = head("3.0", "ASCII") + points_text() +
                           "CELLS 2 16\n4 0 1 2 3\n10 1 0 2 5 4 4 4 4 4 4\nCELL_TYPES 2\n10 24\n";
  check_two(parse_vtk(text, "mesh"));
}

TEST_CASE("vtk: binary files cut off anywhere are refused") {
  const std::string whole = binary<double, std::int64_t>(true, "double", "vtktypeint64");
  const auto end = whole.find("\nCELL_DATA");
  for (std::size_t size = 0; size < end; ++size)
    REQUIRE_THAT(vtk_complaint(whole.substr(0, size)), Catch::StartsWith("mesh:"));
}

TEST_CASE("vtk: without tetrahedra it says what there is") {
  CHECK(vtk_complaint(replaced(ascii3(), "\n5 10\n10", "\n5 9\n9")) ==
        "mesh: has no tetrahedra; it has 5 triangles");
  CHECK(vtk_complaint(replaced(ascii3(), "\n5 10\n10", "\n5 9\n41")) ==
        "mesh: has 1 sets of points, which are not read: a domain without them would have holes");
  CHECK(vtk_complaint("# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n") ==
        "mesh:5: the file has no POINTS");
}

TEST_CASE("vtk: what is wrong is named with its line") {
  CHECK(vtk_complaint("") == "mesh:1: expected '# vtk DataFile Version', found ''");
  CHECK(vtk_complaint("# vtk DataFile Version 6.0\nx\nASCII\n") ==
        "mesh:1: this version of .vtk is not read; those up to 5.1 are");
  CHECK(vtk_complaint("# vtk DataFile Version 3.0\nx\nxml\n") ==
        "mesh:3: expected ASCII or BINARY, found 'xml'");
  CHECK(vtk_complaint(head("3.0", "ASCII")) == "mesh:5: the file has no POINTS");
  CHECK(vtk_complaint(head("3.0", "ASCII") + points_text()) == "mesh:7: the file has no CELLS");
  CHECK(vtk_complaint(head("3.0", "ASCII") + points_text() + cells3 + "POINT_DATA 6\n") ==
        "mesh:11: the file has no CELL_TYPES");
  CHECK(vtk_complaint(head("3.0", "ASCII") + cells3) == "mesh:5: CELLS come before POINTS");
  CHECK(vtk_complaint(head("3.0", "ASCII") + "VERTICES 3\n") ==
        "mesh:5: expected POINTS, CELLS or CELL_TYPES, found 'VERTICES'");
  CHECK(vtk_complaint(replaced(ascii3(), "9 9 9", "9 nan 9")) ==
        "mesh:6: coordinate y is not finite: 'nan'");
  CHECK(vtk_complaint(replaced(ascii3(), "4 1 0 2 5", "4 1 0 2 6")) ==
        "mesh:10: a cell names point 6, but there are 6 points");
  CHECK(vtk_complaint(replaced(ascii5(), "2 5\n", "2 -1\n")) ==
        "mesh:12: a cell names point -1, but there are 6 points");
  CHECK(vtk_complaint(replaced(ascii3(), "4 1 0 2 5", "5 1 0 2 5")) ==
        "mesh:10: cell 2 has 5 points, but only 4 are left for it");
  CHECK(vtk_complaint(replaced(ascii3(), "CELLS 3 14", "CELLS 3 15")) ==
        "mesh:10: the cells are made of 14 numbers, not of 15");
  CHECK(vtk_complaint(replaced(ascii3(), "CELLS 3 14", "CELLS 3 2")) ==
        "mesh:7: 3 cells cannot be made of 2 numbers");
  CHECK(vtk_complaint(replaced(ascii3(), "CELL_TYPES 3", "CELL_TYPES 2")) ==
        "mesh:11: there are 2 types for 3 cells");
  CHECK(vtk_complaint(replaced(ascii3(), "\n5 10", "\n10 10")) ==
        "mesh:12: cell 0, a tetrahedron of type 10, has 3 points");
  CHECK(vtk_complaint(replaced(ascii5(), "0 3 7 11", "0 7 3 11")) ==
        "mesh:9: offset 2 is 3 after 7, of 11");
  CHECK(vtk_complaint(replaced(ascii5(), "0 3 7 11", "0 3 7 10")) ==
        "mesh:9: the last offset is 10, but the cells have 11 points");
  CHECK(vtk_complaint(replaced(ascii3(), "POINTS 6 double", "POINTS 6 words")) ==
        "mesh:5: numbers of type 'words' are not read");
  CHECK(vtk_complaint(replaced(ascii3(), "POINTS 6 double", "POINTS 99999 double")) ==
        "mesh:5: there should be 99999 points, but only " +
            std::to_string(ascii3().size() - ascii3().find(" double")) + " bytes follow");
  CHECK_THAT(vtk_complaint(replaced(ascii3(), "CELLS 3 14", "CELLS 3 99999999999999")),
             Contains("mesh:7: there should be 99999999999999"));
}

}  // namespace vtk_legacy_test
