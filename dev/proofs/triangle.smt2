; Points inside a triangle patch (specification, section 6) are in the triangle, for all locations.
;
; r is the location of a ring, a that of a point along one of its edges, both 16.16.
; Not all contexts keep the premises (docs/proof.md). `z3` answers unsat: no
; such locations give a coordinate below 0, or a product that does not fit 32 bits.
(set-logic QF_BV)
(declare-const r (_ BitVec 64))
(declare-const a (_ BitVec 64))
(define-const ONE (_ BitVec 64) #x0000000000010000)
(define-const HALF (_ BitVec 64) #x0000000000008000)
(define-const TWO_THIRDS (_ BitVec 64) #x000000000000aaaa)

; The premises: no point of a ring is before the ring, except by up to 10 where section 12 says so,
; which is far from the edge; and both ends of an edge are alike.
(define-fun near ((before (_ BitVec 64)) (behind (_ BitVec 64))) Bool
  (or (bvule before behind)
      (and (bvuge before #x0000000000000400) (bvule before (bvadd behind #x000000000000000a)))))
(assert (bvule r (bvadd HALF #x000000000000000a)))
(assert (bvule a ONE))
(assert (near r a))
(assert (near r (bvsub ONE a)))

; The formula.
(define-const product (_ BitVec 64) (bvadd (bvmul r TWO_THIRDS) HALF))
(define-const distance (_ BitVec 64) (bvlshr product #x0000000000000010))
(define-const shift (_ BitVec 64) (bvlshr (bvadd distance #x0000000000000001) #x0000000000000001))
(define-const q (_ BitVec 64) (bvsub a shift))

; What must not be.
(assert (or (bvugt product #x00000000ffffffff)
            (bvult a shift)
            (bvugt (bvadd q distance) ONE)))
(check-sat)
