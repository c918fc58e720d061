! SPDX-License-Identifier: BSD-3-Clause
! The mean height of the particles in the last frame of a run: heights FILE
program heights
  use iso_c_binding
  implicit none

  interface
    integer(c_int) function granular_open(paths, count, options, run) bind(c)
      import
      type(c_ptr), intent(in) :: paths(*)
      integer(c_size_t), value :: count
      type(c_ptr), value :: options
      type(c_ptr), intent(out) :: run
    end function
    integer(c_int) function granular_read_into(run, frame, request, to, count, rows) bind(c)
      import
      type(c_ptr), value :: run, request, to
      integer(c_int64_t), value :: frame
      integer(c_size_t), value :: count
      integer(c_int64_t), intent(out) :: rows
    end function
    subroutine granular_close(run) bind(c)
      import
      type(c_ptr), value :: run
    end subroutine
  end interface

  ! granular_destination
  type, bind(c) :: destination
    type(c_ptr) :: array
    integer(c_int) :: type
    type(c_ptr) :: data
    integer(c_size_t) :: values
  end type
  integer(c_int), parameter :: float64 = 9

  character(len=1024) :: argument
  character(len=1024, kind=c_char), target :: path
  character(len=7, kind=c_char), target :: points = "points" // c_null_char
  real(c_double), allocatable, target :: x(:, :)
  type(destination), target :: to
  type(c_ptr) :: run, paths(1)
  integer(c_int64_t) :: rows

  call get_command_argument(1, argument)
  path = trim(argument) // c_null_char
  paths(1) = c_loc(path)
  if (granular_open(paths, 1_c_size_t, c_null_ptr, run) /= 0) stop "the file cannot be opened"

  ! with no room, the function says how many rows there are
  allocate(x(3, 0))
  to = destination(c_loc(points), float64, c_null_ptr, 0)
  rows = 0
  if (granular_read_into(run, -1_c_int64_t, c_null_ptr, c_loc(to), 1_c_size_t, rows) /= 0) then
    deallocate(x)
    allocate(x(3, rows))
    to = destination(c_loc(points), float64, c_loc(x), size(x, kind=c_size_t))
    if (granular_read_into(run, -1_c_int64_t, c_null_ptr, c_loc(to), 1_c_size_t, rows) /= 0) &
      stop "the frame cannot be read"
  end if
  print "(i0, 1x, f0.9)", rows, sum(x(3, :)) / rows
  call granular_close(run)
end program
