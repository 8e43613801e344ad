// The one function of Windows that Rust's standard library takes from bcryptprimitives.dll, which Wine before
// version 9 does not have. Tests under Wine alone use it.
#include <windows.h>

BOOLEAN NTAPI SystemFunction036(PVOID buffer, ULONG length);

__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE buffer, SIZE_T length) {
    return SystemFunction036(buffer, (ULONG)length);
}
