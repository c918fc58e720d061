// SPDX-License-Identifier: BSD-3-Clause
#include "vtu_file.h"

#include "arrays.h"
#include "voxels.h"

#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLUnstructuredGridReader.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace vtkGranularPrivate
{
namespace
{
/**
 * Keeps what a reader has to complain about, first of all, instead of printing it.
 */
class Complaints : public vtkCommand
{
public:
  static Complaints* New() { return new Complaints; }

  void Execute(vtkObject*, unsigned long, void* text) override
  {
    if (this->First.empty() && text)
    {
      this->First = static_cast<const char*>(text);
    }
  }

  std::string First;
};

/**
 * On one line, and without the place in VTK's sources that the text begins with.
 */
std::string OneLine(std::string text)
{
  const std::size_t start = text.find("): ");
  text.erase(0, start == text.npos ? 0 : start + 3);
  std::replace(text.begin(), text.end(), '\n', ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

/**
 * Leaves out what VTK notes of its arrays' ranges: it prints these numbers as the program's locale has them.
 */
void LeaveOutKeys(std::string& text)
{
  const std::string_view end = "</InformationKey>\n";
  for (auto at = text.find("<InformationKey"); at != text.npos;
       at = text.find("<InformationKey", at))
  {
    const std::size_t line = text.rfind('\n', at) + 1;
    text.erase(line, text.find(end, at) + end.size() - line);
    at = line;
  }
}
}

granular::Decomposition ReadVtu(
  const granular::ByteSource& source, const granular::FrameEntry& entry, granular::Notices& notices)
{
  const granular::Where where = granular::where_of(source.path(), entry);
  // each cell has 8 corners; compressed, deflate packs at most 1032 bytes into one
  constexpr std::int64_t most_cells_a_byte = 1032 / 8;
  if (entry.rows / most_cells_a_byte > entry.end)
  {
    throw granular::FormatError("expected bytes of " + std::to_string(entry.rows) + " cells, got " +
        std::to_string(entry.end) + " bytes in all",
      where);
  }
  std::string bytes(static_cast<std::size_t>(entry.end), '\0');
  bytes.resize(source.read(0, bytes.data(), bytes.size()));
  vtkNew<Complaints> complaints;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  for (unsigned long event : { vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
  {
    reader->AddObserver(event, complaints);
    reader->GetExecutive()->AddObserver(event, complaints);
    reader->SetReaderErrorObserver(complaints);
    reader->SetParserErrorObserver(complaints);
  }
  reader->ReadFromInputStringOn();
  reader->SetInputString(bytes);
  reader->Update();
  if (!complaints->First.empty())
  {
    throw granular::FormatError(
      "expected a .vtu file that VTK can read, got: " + OneLine(complaints->First), where);
  }
  try
  {
    return ReadVoxels(reader->GetOutput(), notices);
  }
  catch (const granular::UnsupportedError& error)
  {
    throw granular::UnsupportedError(error.text(), where);
  }
  catch (const granular::Error& error)
  {
    throw granular::FormatError(
      error.text(), { where.path, where.line, where.byte, error.where().column });
  }
}

std::string EncodeVtu(
  const granular::Decomposition& decomposition, std::optional<double> time, const std::string& path)
{
  vtkNew<vtkUnstructuredGrid> grid;
  granular::Progress progress;
  FillVoxels(grid, decomposition, {}, progress);
  if (time)
  {
    grid->GetFieldData()->AddArray(MakeDoubles("TimeValue", { *time }));
  }
  vtkNew<Complaints> complaints;
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->AddObserver(vtkCommand::ErrorEvent, complaints);
  writer->SetInputData(grid);
  writer->SetDataModeToAscii();
  writer->SetCompressorTypeToNone();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0 || !complaints->First.empty())
  {
    throw granular::Error(
      "expected VTK to write voxels, got: " + OneLine(complaints->First), { path });
  }
  std::string text = writer->GetOutputString();
  LeaveOutKeys(text);
  return text;
}
}
