// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularHistory.h"

#include "private/arrays/arrays.h"
#include "private/paths/path_task.h"
#include "private/request/print.h"

#include "granular/paths/history.h"

#include "vtkDataSetAttributes.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularHistory);

//------------------------------------------------------------------------------
class vtkGranularHistory::Task : public FilterTask<vtkGranularHistory, PathTask>
{
public:
  using FilterTask::FilterTask;

private:
  void Execute() override
  {
    granular::PathTask task = this->Choose();
    granular::Table table = granular::make_history(task,
      { this->Self->OutputType == STATISTICS, this->Self->Quantiles,
        this->Self->MeanSquareDisplacement, this->Threads });
    if (this->Wanted.Piece != 0)
    {
      return; // one table: that of the first rank or piece
    }
    for (granular::TableArray& array : table.arrays)
    {
      this->GetOutput<vtkTable>()->AddColumn(TakeArray(array, table.rows, {}));
    }
  }
};

vtkGranularExecuteMacro(vtkGranularHistory);
vtkGranularOutputMacro(vtkGranularHistory, GetOutput, vtkTable, 0);

//------------------------------------------------------------------------------
vtkGranularHistory::vtkGranularHistory()
{
  this->SetPorts({ Input::Required }, { "vtkTable" });
}

vtkGranularPrintMacro(vtkGranularHistory, OutputType, Quantiles, MeanSquareDisplacement);
