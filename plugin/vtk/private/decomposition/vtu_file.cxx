// SPDX-License-Identifier: BSD-3-Clause
#include "private/decomposition/vtu_file.h"

#include "private/arrays/arrays.h"
#include "private/decomposition/voxels.h"

#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkType.h"
#include "vtkTypeInt32Array.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace vtkGranularPrivate
{
namespace
{
/**
 * Keeps what a writer has to complain about, first of all, instead of printing it.
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
 * The counts have 32 bits, as LIGGGHTS-INL writes them, where all fit.
 */
void ShortenCounts(vtkUnstructuredGrid* grid)
{
  vtkDataArray* counts = grid->GetCellData()->GetArray("nlocal");
  if (!counts || counts->GetNumberOfTuples() == 0 || counts->GetRange()[1] > VTK_TYPE_INT32_MAX)
  {
    return;
  }
  vtkNew<vtkTypeInt32Array> shorter;
  shorter->DeepCopy(counts);
  grid->GetCellData()->AddArray(shorter); // in the place of the other
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

std::string EncodeVtu(
  const granular::Decomposition& decomposition, std::optional<double> time, const std::string& path)
{
  vtkNew<vtkUnstructuredGrid> grid;
  granular::Progress progress;
  FillVoxels(grid, decomposition, {}, progress);
  ShortenCounts(grid);
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
