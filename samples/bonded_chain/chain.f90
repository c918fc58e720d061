! SPDX-License-Identifier: BSD-3-Clause
! A chain of bonded particles in the memory of a simulation code: two ranks share it, send each other copies and particles, and
! write restart records. Here both ranks are objects of one program; a code on many ranks sends the buffers by MPI.
program chain
  use iso_c_binding
  implicit none

  ! granular_bonds_arrays
  type, bind(c) :: arrays
    integer(c_size_t) :: size, capacity
    integer(c_int32_t) :: most_bonds, history_values
    type(c_ptr) :: x, v, f, x_mol, v_mol, tag, molecule, type, mask, image
    type(c_ptr) :: bonds, bond_types, partners, history
    integer(c_size_t) :: memory, described
  end type

  interface
    integer(c_int) function granular_bonds_create(most_bonds, history_values, particles) bind(c)
      import
      integer(c_int32_t), value :: most_bonds, history_values
      type(c_ptr), intent(out) :: particles
    end function
    subroutine granular_bonds_destroy(particles) bind(c)
      import
      type(c_ptr), value :: particles
    end subroutine
    type(c_ptr) function granular_bonds_last_error() bind(c)
      import
    end function
    integer(c_int) function granular_bonds_grow(particles, capacity) bind(c)
      import
      type(c_ptr), value :: particles
      integer(c_size_t), value :: capacity
    end function
    integer(c_int) function granular_bonds_resize(particles, size) bind(c)
      import
      type(c_ptr), value :: particles
      integer(c_size_t), value :: size
    end function
    integer(c_int) function granular_bonds_add(particles, type, x, row) bind(c)
      import
      type(c_ptr), value :: particles
      integer(c_int32_t), value :: type
      real(c_double), intent(in) :: x(3)
      integer(c_size_t), intent(out) :: row
    end function
    integer(c_int) function granular_bonds_add_bond(particles, row, type, partner, history) bind(c)
      import
      type(c_ptr), value :: particles
      integer(c_size_t), value :: row
      integer(c_int32_t), value :: type
      integer(c_int64_t), value :: partner
      real(c_double), intent(in) :: history(*)
    end function
    integer(c_int) function granular_bonds_remove(particles, row) bind(c)
      import
      type(c_ptr), value :: particles
      integer(c_size_t), value :: row
    end function
    integer(c_int) function granular_bonds_view(particles, view) bind(c)
      import
      type(c_ptr), value :: particles
      type(arrays), intent(out) :: view
    end function
    integer(c_int) function granular_bonds_pack(particles, kind, first, count, list, shift, buffer, room, doubles) bind(c)
      import
      type(c_ptr), value :: particles, list, shift
      integer(c_int), value :: kind
      integer(c_size_t), value :: first, count, room
      real(c_double), intent(inout) :: buffer(*)
      integer(c_size_t), intent(out) :: doubles
    end function
    integer(c_int) function granular_bonds_unpack(particles, kind, first, list, buffer, doubles, count) bind(c)
      import
      type(c_ptr), value :: particles, list, count
      integer(c_int), value :: kind
      integer(c_size_t), value :: first, doubles
      real(c_double), intent(in) :: buffer(*)
    end function
    integer(c_int) function granular_bonds_pack_record(particles, row, form, fixes, fix_count, buffer, room, doubles) bind(c)
      import
      type(c_ptr), value :: particles, form, fixes
      integer(c_size_t), value :: row, fix_count, room
      real(c_double), intent(inout) :: buffer(*)
      integer(c_size_t), intent(out) :: doubles
    end function
    integer(c_int) function granular_bonds_unpack_record(particles, form, fix_count, chunk, chunk_doubles, doubles) bind(c)
      import
      type(c_ptr), value :: particles, form
      integer(c_size_t), value :: fix_count, chunk_doubles
      real(c_double), intent(in) :: chunk(*)
      integer(c_size_t), intent(out) :: doubles
    end function
  end interface

  integer(c_int), parameter :: comm = 0, border = 2, reverse = 5, exchange = 6
  integer, parameter :: particles_in_all = 6, history_values = 3
  integer(c_int32_t), target :: at_the_border(1) = 2 ! rows begin at 0
  type(c_ptr) :: left, right, restarted
  type(arrays) :: view
  real(c_double), pointer :: x(:, :), f(:, :)
  integer(c_int64_t), pointer :: tags(:)
  real(c_double) :: buffer(1000)
  integer(c_size_t) :: own, doubles, place, row
  integer :: tag

  left = new()
  right = new()
  do tag = 1, particles_in_all
    call add(merge(left, right, tag <= 3), tag)
  end do

  ! the right rank needs a copy of particle 3, the last one of the left rank, behind its own; then only its new position
  call need(granular_bonds_view(right, view))
  own = view%size
  doubles = packed(left, border)
  print "(a, i0, a)", "border: ", doubles, " doubles"
  call need(granular_bonds_unpack(right, border, own, c_null_ptr, buffer, doubles, c_null_ptr))
  call need(granular_bonds_view(left, view))
  call c_f_pointer(view%x, x, [3, int(view%size)])
  x(1, 3) = 1.75
  doubles = packed(left, comm)
  print "(a, i0, a)", "comm: ", doubles, " doubles"
  call need(granular_bonds_unpack(right, comm, own, c_null_ptr, buffer, doubles, c_null_ptr))
  call need(granular_bonds_view(right, view))
  call c_f_pointer(view%x, x, [3, int(view%size)])
  call c_f_pointer(view%f, f, [3, int(view%size)])
  call c_f_pointer(view%tag, tags, [view%size])
  print "(a, i0, a, f4.2)", "copy of particle ", tags(own + 1), " at ", x(1, own + 1)

  ! the force on the copy goes back
  f(1, own + 1) = -8
  call need(granular_bonds_pack(right, reverse, own, 1_c_size_t, c_null_ptr, c_null_ptr, buffer, 3_c_size_t, doubles))
  call need(granular_bonds_unpack(left, reverse, 0_c_size_t, c_loc(at_the_border), buffer, doubles, c_null_ptr))
  call need(granular_bonds_view(left, view))
  call c_f_pointer(view%f, f, [3, int(view%size)])
  print "(a, f4.1)", "force on particle 3: ", f(1, 3)

  ! particle 3 goes to the right rank, with its bonds; copies end first
  call need(granular_bonds_resize(right, own))
  doubles = packed(left, exchange)
  print "(a, i0, a)", "exchange: ", doubles, " doubles"
  call need(granular_bonds_unpack(right, exchange, own, c_null_ptr, buffer, doubles, c_null_ptr))
  call need(granular_bonds_remove(left, 2_c_size_t))
  call show("left", left)
  call show("right", right)

  ! the records of a restart file, and what is read from them
  place = 0
  call need(granular_bonds_view(right, view))
  do row = 0, view%size - 1
    call need(granular_bonds_pack_record(right, row, c_null_ptr, c_null_ptr, 0_c_size_t, buffer(place + 1), &
      size(buffer) - place, doubles))
    place = place + doubles
  end do
  print "(a, i0, a)", "restart: ", place, " doubles"
  own = place
  place = 0
  restarted = new()
  do while (place < own)
    call need(granular_bonds_unpack_record(restarted, c_null_ptr, 0_c_size_t, buffer(place + 1), own - place, doubles))
    place = place + doubles
  end do
  call show("restarted", restarted)
  call need(granular_bonds_view(restarted, view))
  print "(a, i0, a)", "memory: ", view%memory, " bytes"
  call granular_bonds_destroy(left)
  call granular_bonds_destroy(right)
  call granular_bonds_destroy(restarted)

contains

  ! Ends the program with the message of the library.
  subroutine need(status)
    integer(c_int), intent(in) :: status
    character(kind=c_char), pointer :: text(:)
    integer :: i

    if (status == 0) return
    call c_f_pointer(granular_bonds_last_error(), text, [1000])
    do i = 1, 1000
      if (text(i) == c_null_char) exit
      write (*, "(a)", advance="no") text(i)
    end do
    print *
    stop 1
  end subroutine

  type(c_ptr) function new()
    call need(granular_bonds_create(2, history_values, new))
    call need(granular_bonds_grow(new, 0_c_size_t)) ! room for 10,000 at once
  end function

  ! Adds a particle of the chain, with bonds to those beside it and a history of its own.
  subroutine add(particles, tag)
    type(c_ptr), intent(in) :: particles
    integer, intent(in) :: tag
    type(arrays) :: view
    integer(c_int64_t), pointer :: tags(:)
    integer(c_size_t) :: row
    integer :: partner

    call need(granular_bonds_add(particles, 1, [0.5d0 * tag, 0d0, 0d0], row))
    call need(granular_bonds_view(particles, view))
    call c_f_pointer(view%tag, tags, [view%size])
    tags(row + 1) = tag
    do partner = tag - 1, tag + 1, 2
      if (partner >= 1 .and. partner <= particles_in_all) then
        call need(granular_bonds_add_bond(particles, row, 1, int(partner, c_int64_t), [0.1d0 * tag, 0.2d0 * partner, 0d0]))
      end if
    end do
  end subroutine

  ! Packs the rows at the border for another rank, and returns the number of doubles.
  integer(c_size_t) function packed(particles, kind)
    type(c_ptr), intent(in) :: particles
    integer(c_int), intent(in) :: kind

    call need(granular_bonds_pack(particles, kind, 0_c_size_t, 1_c_size_t, c_loc(at_the_border), c_null_ptr, buffer, &
      size(buffer, kind=c_size_t), packed))
  end function

  subroutine show(rank, particles)
    character(*), intent(in) :: rank
    type(c_ptr), intent(in) :: particles
    type(arrays) :: view
    integer(c_int64_t), pointer :: tags(:)
    integer(c_int32_t), pointer :: bonds(:)
    real(c_double), pointer :: history(:, :, :)
    real(c_double) :: total
    integer :: i

    call need(granular_bonds_view(particles, view))
    call c_f_pointer(view%tag, tags, [view%size])
    call c_f_pointer(view%bonds, bonds, [view%size])
    call c_f_pointer(view%history, history, [history_values, int(view%most_bonds), int(view%size)])
    total = 0
    do i = 1, int(view%size)
      total = total + sum(history(:, 1:bonds(i), i))
    end do
    print "(a, a, *(1x, i0))", rank, ":", tags
    print "(2x, i0, a, f4.1)", sum(bonds), " bonds, history ", total
  end subroutine
end program
