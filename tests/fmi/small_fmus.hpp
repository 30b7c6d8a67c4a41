#pragma once

#include <string>
#include <vector>

#include "fmi/zip_archive.hpp"

namespace ballbot {

/// A folder below the temporary one, for the life of the process, with files to give away.
std::string smallFmuFolder();

/// An FMU of FMI 2 with these variables, as XML; it has a binary in name only.
std::string fmi2File(const std::string& name, const std::string& variables,
                     const std::string& types = "", const std::vector<ZipEntry>& more = {});
/// The same of FMI 3.
std::string fmi3File(const std::string& name, const std::string& variables,
                     const std::string& more_xml = "");
/// The XML of both.
std::string fmi2Xml(const std::string& variables, const std::string& types = "");
std::string fmi3Xml(const std::string& variables, const std::string& more = "");

/// One variable of FMI 2: <ScalarVariable ...><Real/></ScalarVariable>.
std::string scalar(const std::string& name, const std::string& causality = "input",
                   const std::string& type = "Real", int reference = 0);

/// The tests' FMU of values_fmu.cpp: inputs in_Int8, ..., outputs out_Int8, ..., a matrix.
std::string valuesFmu();

}  // namespace ballbot
