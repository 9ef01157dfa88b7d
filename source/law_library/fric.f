C     SPDX-License-Identifier: LGPL-2.1-or-later
C
C     User subroutine FRIC of ABAQUS/Standard with the friction law of slipstep.
C     The law is read from the file <name of the interaction>.prm, in lower case,
C     in the folder of the job; "slipstep export" writes it. Units: mm, s, N, MPa.
C     Link with -lslipstep_friction.
C
      SUBROUTINE FRIC(LM,TAU,DDTDDG,DDTDDP,DSLIP,SED,SFD,
     1 DDTDDT,PNEWDT,STATEV,DGAM,TAULM,PRESS,DPRESS,DDPDDH,SLIP,
     2 KSTEP,KINC,TIME,DTIME,NOEL,CINAME,SLNAME,MSNAME,NPT,NODE,
     3 NPATCH,COORDS,RCOORD,DROT,TEMP,PREDEF,NFDIR,MCRD,NPRED,
     4 NSTATV,CHRLNGTH,PROPS,NPROPS)
      USE, INTRINSIC :: ISO_C_BINDING
      IMPLICIT NONE
      INTEGER LM,KSTEP,KINC,NOEL,NPT,NODE,NPATCH,NFDIR,MCRD,NPRED,
     1 NSTATV,NPROPS
      CHARACTER*80 CINAME,SLNAME,MSNAME
      REAL*8 TAU(NFDIR),DDTDDG(NFDIR,NFDIR),DDTDDP(NFDIR),
     1 DSLIP(NFDIR),DDTDDT(NFDIR,2),STATEV(*),DGAM(NFDIR),
     2 TAULM(NFDIR),SLIP(NFDIR),TIME(2),COORDS(MCRD),RCOORD(MCRD),
     3 DROT(2,2),TEMP(2),PREDEF(2,*),PROPS(NPROPS)
      REAL*8 SED,SFD,PNEWDT,PRESS,DPRESS,DDPDDH,DTIME,CHRLNGTH

      INTERFACE
        INTEGER(C_INT) FUNCTION SLIPSTEP_STEP(LAW,FIRST,SLIP,PRESSURE,
     1   TIME_STEP,LAST,TRACTION,D_SLIP,D_PRESSURE,MESSAGE,LENGTH)
     2   BIND(C,NAME='slipstep_step')
          IMPORT :: C_INT,C_PTR,C_DOUBLE,C_CHAR,C_SIZE_T
          TYPE(C_PTR),VALUE :: LAW
          REAL(C_DOUBLE) :: FIRST(*),SLIP(2),LAST(*),TRACTION(2),
     1     D_SLIP(2,2),D_PRESSURE(2)
          REAL(C_DOUBLE),VALUE :: PRESSURE,TIME_STEP
          CHARACTER(KIND=C_CHAR) :: MESSAGE(*)
          INTEGER(C_SIZE_T),VALUE :: LENGTH
        END FUNCTION
        TYPE(C_PTR) FUNCTION SLIPSTEP_LAW_NAMED(FOLDER,NAME,MESSAGE,
     1   LENGTH) BIND(C,NAME='slipstep_law_named')
          IMPORT :: C_PTR,C_CHAR,C_SIZE_T
          CHARACTER(KIND=C_CHAR) :: FOLDER(*),NAME(*),MESSAGE(*)
          INTEGER(C_SIZE_T),VALUE :: LENGTH
        END FUNCTION
        INTEGER(C_INT) FUNCTION SLIPSTEP_STATE_SIZE(LAW)
     1   BIND(C,NAME='slipstep_state_size')
          IMPORT :: C_INT,C_PTR
          TYPE(C_PTR),VALUE :: LAW
        END FUNCTION
        SUBROUTINE SLIPSTEP_INITIAL_STATE(LAW,STATE)
     1   BIND(C,NAME='slipstep_initial_state')
          IMPORT :: C_PTR,C_DOUBLE
          TYPE(C_PTR),VALUE :: LAW
          REAL(C_DOUBLE) :: STATE(*)
        END SUBROUTINE
        SUBROUTINE SLIPSTEP_TURN_STATE(LAW,STATE,TURN)
     1   BIND(C,NAME='slipstep_turn_state')
          IMPORT :: C_PTR,C_DOUBLE
          TYPE(C_PTR),VALUE :: LAW
          REAL(C_DOUBLE) :: STATE(*),TURN(2,2)
        END SUBROUTINE
        REAL(C_DOUBLE) FUNCTION SLIPSTEP_TANGENTIAL_STIFFNESS(LAW)
     1   BIND(C,NAME='slipstep_tangential_stiffness')
          IMPORT :: C_PTR,C_DOUBLE
          TYPE(C_PTR),VALUE :: LAW
        END FUNCTION
      END INTERFACE

C     As many numbers as a law may have; where they stand.
      INTEGER, PARAMETER :: MOST=64, NORMAL=3, DISSIPATION=10, MU=7
      TYPE(C_PTR) :: LAW
      REAL*8 FIRST(MOST),LAST(MOST),MOTION(2),TRACTION(2),D_SLIP(2,2),
     1 D_PRESSURE(2),STIFFNESS
      CHARACTER*256 FOLDER
      CHARACTER*512 MESSAGE
      INTEGER I,J,N,LENGTH,FAILED

      CALL GETOUTDIR(FOLDER,LENGTH)
      MESSAGE=' '
      LAW=SLIPSTEP_LAW_NAMED(FOLDER(1:LENGTH)//C_NULL_CHAR,
     1 TRIM(CINAME)//C_NULL_CHAR,MESSAGE,INT(512,C_SIZE_T))
      IF (.NOT.C_ASSOCIATED(LAW)) CALL FRIC_STOP(MESSAGE)
      N=SLIPSTEP_STATE_SIZE(LAW)
      IF (N.GT.NSTATV) THEN
        WRITE(MESSAGE,'(A,I3,A,I3)')
     1   'slipstep: the law needs DEPVAR=',N,', given are ',NSTATV
        CALL FRIC_STOP(TRIM(MESSAGE)//C_NULL_CHAR)
      END IF

C     An untouched point has no coefficient of friction yet.
      IF (STATEV(MU).EQ.0.D0) THEN
        CALL SLIPSTEP_INITIAL_STATE(LAW,FIRST)
      ELSE
        FIRST(1:N)=STATEV(1:N)
C       Row by row in C. Angles of anisotropy, direction and texture are
C       counted from the slip directions as they are.
        IF (NFDIR.EQ.2) CALL SLIPSTEP_TURN_STATE(LAW,FIRST,
     1   TRANSPOSE(DROT))
      END IF
C     The stress of the start comes in the axes of today.
      FIRST(1:2)=0.D0
      MOTION=0.D0
      MOTION(1:NFDIR)=DGAM(1:NFDIR)
      IF (LM.EQ.2) THEN
        FIRST(NORMAL)=0.D0
      ELSE
        FIRST(1:NFDIR)=TAU(1:NFDIR)
      END IF

      FAILED=SLIPSTEP_STEP(LAW,FIRST,MOTION,PRESS,DTIME,LAST,TRACTION,
     1 D_SLIP,D_PRESSURE,MESSAGE,INT(512,C_SIZE_T))
      IF (FAILED.NE.0) THEN
C       A shorter increment may have a solution.
        WRITE(7,'(A)') 'slipstep: '//
     1   MESSAGE(1:INDEX(MESSAGE//C_NULL_CHAR,C_NULL_CHAR)-1)
        PNEWDT=0.25D0
        RETURN
      END IF

      STIFFNESS=SLIPSTEP_TANGENTIAL_STIFFNESS(LAW)
      DO I=1,NFDIR
        DSLIP(I)=MOTION(I)-(TRACTION(I)-FIRST(I))/STIFFNESS
        TAU(I)=TRACTION(I)
        DDTDDP(I)=D_PRESSURE(I)
C       Row by row in C, column by column here.
        DO J=1,NFDIR
          DDTDDG(I,J)=D_SLIP(J,I)
        END DO
      END DO
      SED=DOT_PRODUCT(TRACTION,TRACTION)/(2.D0*STIFFNESS)
      SFD=LAST(DISSIPATION)-FIRST(DISSIPATION)
      STATEV(1:N)=LAST(1:N)
      LM=0
      RETURN
      END


C     A message of C, then the end of the job.
      SUBROUTINE FRIC_STOP(MESSAGE)
      USE, INTRINSIC :: ISO_C_BINDING
      CHARACTER*(*) MESSAGE
      INTEGER LENGTH
      LENGTH=INDEX(MESSAGE//C_NULL_CHAR,C_NULL_CHAR)-1
      WRITE(7,'(A)') MESSAGE(1:LENGTH)
      WRITE(*,'(A)') MESSAGE(1:LENGTH)
      CALL XIT
      END
